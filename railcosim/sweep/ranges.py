"""Values of a grid: as they are listed, or from one number to another."""

from __future__ import annotations

import math
from decimal import Decimal
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import InputError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from .case import Swept

MOST_CASES = 1_000_000
"""Cases that a study may have."""

ALLOWED = ({"from", "to", "step"}, {"from", "to", "count"})
"""Keys of a range."""


def grid_values(key: str, given: object) -> tuple[Swept, ...]:
    """Return the values that a grid gives a key.

    Parameters
    ----------
    key : str
        ``section.key``, for the messages.
    given : object
        A list, or a table with ``from``, ``to`` and ``step`` or ``count``.

    Raises
    ------
    InputError
        For anything else, for no values or for a value that occurs twice.
    """
    if isinstance(given, dict):
        values = _range(key, given)
    elif isinstance(given, list):
        values = tuple(given)
    else:
        raise InputError(
            f"sweep.grid.{key} is {given!r} but must be a list of values or a range, as in "
            "{ from = 5, to = 100, step = 5 }"
        )
    if not values:
        raise InputError(f"sweep.grid.{key} has no values: give one, or leave the key out")
    for value in values:
        if isinstance(value, (dict, list)):
            raise InputError(f"sweep.grid.{key} holds {value!r} but must be a list of plain values")
    if len(set(values)) < len(values):
        twice = next(value for n, value in enumerate(values) if value in values[:n])
        raise InputError(f"sweep.grid.{key} holds {twice} twice: leave one of them out")
    return values


def number(key: str, name: str, value: object) -> float:
    """Return a finite number of a table, or refuse what it has instead.

    Parameters
    ----------
    key, name : str
        Full name of the table and the key in it, for the message.
    value : object
        What was given.

    Raises
    ------
    InputError
        For anything else than a finite number.
    """
    if isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < math.inf:
        return value
    raise InputError(f"{key}.{name} is {value!r} but must be a finite number")


def _range(key: str, given: Mapping[str, Any]) -> tuple[Swept, ...]:
    name = f"sweep.grid.{key}"
    if set(given) not in ALLOWED:
        raise InputError(
            f"{name} has the keys {', '.join(given) or 'none'} but a range has from, to and step, "
            "or from, to and count"
        )
    start, end = number(name, "from", given["from"]), number(name, "to", given["to"])
    if "step" in given:
        return _stepped(name, start, end, number(name, "step", given["step"]))
    points = given["count"]
    if not isinstance(points, int) or isinstance(points, bool) or not 2 <= points <= MOST_CASES:
        raise InputError(f"{name}.count is {points!r} but must be a whole number of at least 2")
    return tuple(float(value) for value in np.linspace(start, end, points))


def _stepped(name: str, start: float, end: float, step: float) -> tuple[Swept, ...]:
    """Add steps in decimal numbers: 0.1, 0.2, 0.3 and not 0.30000000000000004."""
    first, last, size = (Decimal(repr(value)) for value in (start, end, step))
    if size == 0 or (last - first) / size < 0:
        raise InputError(f"{name}.step is {step:g}, with which {start:g} never comes to {end:g}")
    steps = (last - first) / size
    if steps != steps.to_integral_value():
        raise InputError(
            f"{name} does not come to {end:g} from {start:g} in whole steps of {step:g}: change "
            "one of them"
        )
    if steps >= MOST_CASES:
        raise InputError(f"{name} has {steps + 1} values but a study at most {MOST_CASES} cases")
    kind = int if all(isinstance(value, int) for value in (start, end, step)) else float
    return tuple(kind(first + n * size) for n in range(int(steps) + 1))
