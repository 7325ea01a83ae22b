"""CSV files with what supports have of their own; their first line names the columns."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence

from .tables import read_text

PLACES = ("number", "position")
"""Columns that say which support a row is of: counted from 1, or the nearest to a place [m]."""

LARGEST_NUMBER = 2_000_000
"""Of a support in a table: what the others need up to it is kept in memory."""


def read_support_table(
    path: str, properties: Collection[str], *, spacing: float, supports: int | None
) -> dict[int, dict[str, float]]:
    """Read what supports have of their own.

    Values are separated by commas or semicolons; empty lines and lines that start with ``#`` are
    passed over.

    Parameters
    ----------
    path : str
        The file: one row a support, in any order.
    properties : collection of str
        Names of the columns that it may have besides one of `PLACES`.
    spacing : float
        Distance of the supports [m], of which the first one is as far from 0 m.
    supports : int or None
        How many the track has; None for an endless one.

    Returns
    -------
    dict of int to dict
        Values by the names of their columns, by support, counted from 0.

    Raises
    ------
    ValueError
        For a file that cannot be read, unknown columns, or values that no support has; the message
        names file and line.
    """
    rows = [
        (number, [cell.strip() for cell in line.replace(";", ",").split(",")])
        for number, line in enumerate(read_text(path).splitlines(), start=1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if not rows:
        raise ValueError(f"table {path}: is empty; its first line must name the columns")
    names = rows[0][1]
    _check_names(path, names, properties)
    found: dict[int, dict[str, float]] = {}
    for line, cells in rows[1:]:
        where = f"table {path}, line {line}"
        values = _numbers(where, names, cells)
        support = _support(where, values, spacing, supports)
        if support in found:
            raise ValueError(f"{where}: support {support + 1} has a row already; leave one out")
        found[support] = values
    return found


def _check_names(path: str, names: Sequence[str], properties: Collection[str]) -> None:
    for name in names:
        if name not in (*PLACES, *properties) or names.count(name) > 1:
            raise ValueError(
                f"table {path}: column {name!r} is unknown or there twice; its first line must "
                f"name columns of {', '.join((*PLACES, *properties))}"
            )
    if sum(name in PLACES for name in names) != 1:
        raise ValueError(f"table {path}: must have one of the columns {' and '.join(PLACES)}")


def _numbers(where: str, names: Sequence[str], cells: Sequence[str]) -> dict[str, float]:
    if len(cells) != len(names):
        raise ValueError(f"{where}: has {len(cells)} values, not {len(names)} as the first line")
    values = {}
    for name, cell in zip(names, cells, strict=True):
        try:
            value = float(cell)
        except ValueError:
            value = math.nan
        if not (math.isfinite(value) and value >= 0.0):
            raise ValueError(f"{where}: {name} is {cell!r}, not a number of at least 0")
        if name == "fastened" and value not in {0.0, 1.0}:
            raise ValueError(f"{where}: fastened is {cell!r}, neither 1 nor 0")
        values[name] = value
    return values


def _support(where: str, values: dict[str, float], spacing: float, supports: int | None) -> int:
    """Take the place out of a row and return its support, counted from 0."""
    if "number" in values:
        exact = values.pop("number") - 1.0
        if exact != round(exact):
            raise ValueError(f"{where}: number is {exact + 1.0:g}, not a whole number")
    else:
        exact = values.pop("position") / spacing - 1.0
    support = round(exact)
    if not 0 <= support < (LARGEST_NUMBER if supports is None else supports):
        most = f"the track has {supports}" if supports else f"it may go up to {LARGEST_NUMBER}"
        raise ValueError(
            f"{where}: names support {support + 1} but {most}: correct it"
            f"{', or use more bays or an endless track' if supports else ''}"
        )
    return support
