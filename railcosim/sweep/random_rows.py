"""Random cases: every key has a stream of its own, so that more cases and keys keep the others."""

from __future__ import annotations

import zlib
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import InputError
from .ranges import MOST_CASES, number

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

PARAMETERS = {
    "uniform": ("from", "to"),
    "loguniform": ("from", "to"),
    "normal": ("mean", "deviation"),
}
"""Distributions and what they need."""

FORM = '{ distribution = "uniform", from = 20e6, to = 40e6 }'


def random_rows(
    keys: Mapping[str, object], *, count: object, seed: object
) -> tuple[dict[str, float], ...]:
    """Draw the values of every random case.

    Parameters
    ----------
    keys : mapping of str to object
        Tables with ``distribution`` and its parameters by ``section.key``.
    count : int
        Number of cases; a larger one begins with the same cases.
    seed : int
        Seed of all streams.

    Raises
    ------
    InputError
        For a distribution that there is not or that has other parameters.
    """
    cases = _whole("count", count, 1, MOST_CASES)
    first = _whole("seed", seed, 0, 2**63)
    if not keys:
        raise InputError(
            f"sweep.random has no keys: write for example track.pad_stiffness = {FORM}"
        )
    columns = {key: _draw(key, given, cases, first) for key, given in keys.items()}
    return tuple(
        dict(zip(columns, map(float, row), strict=True))
        for row in zip(*columns.values(), strict=True)
    )


def _whole(name: str, value: object, least: int, most: int) -> int:
    """Return a whole number within limits, or refuse what there is instead."""
    if isinstance(value, int) and not isinstance(value, bool) and least <= value <= most:
        return value
    shown = "missing" if value is None else repr(value)
    raise InputError(
        f"sweep.random.{name} is {shown} but must be a whole number from {least} to {most}"
    )


def _draw(key: str, given: object, count: int, seed: int) -> NDArray[np.float64]:
    """Draw the values of one key, shape (count,)."""
    name = f"sweep.random.{key}"
    kind, first, second = _checked(name, given)
    generator = np.random.default_rng([seed, zlib.crc32(key.encode())])
    if kind == "normal":
        return generator.normal(first, second, count)
    if kind == "uniform":
        return generator.uniform(first, second, count)
    return np.exp(generator.uniform(np.log(first), np.log(second), count))


def _checked(name: str, given: object) -> tuple[str, float, float]:
    """Return the distribution and its two parameters."""
    if not isinstance(given, dict):
        raise InputError(f"{name} is {given!r} but must be a table such as {FORM}")
    values: dict[str, Any] = dict(given)
    kind = values.pop("distribution", None)
    if kind not in PARAMETERS:
        shown = "missing" if kind is None else repr(kind)
        raise InputError(
            f"{name}.distribution is {shown} but must be one of {', '.join(PARAMETERS)}"
        )
    first, second = PARAMETERS[kind]
    if set(values) != {first, second}:
        raise InputError(
            f"{name} has the keys {', '.join(values) or 'none'} but a {kind} distribution has "
            f"{first} and {second}"
        )
    low, high = number(name, first, values[first]), number(name, second, values[second])
    if kind == "normal":
        if high <= 0.0:
            raise InputError(f"{name}.deviation is {high:g} but must be above 0")
    elif not low < high or (kind == "loguniform" and low <= 0.0):
        least = " and above 0" if kind == "loguniform" else ""
        raise InputError(f"{name}.from is {low:g} but must be below {name}.to, {high:g}{least}")
    return kind, low, high
