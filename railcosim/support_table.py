"""CSV files with what supports have of their own; their first line names the columns."""

from __future__ import annotations

import csv
import math
from pathlib import Path
from typing import TYPE_CHECKING

from .errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .track_section import Track

PLACES = ("number", "position")
"""Columns that say which support a row is of: counted from 1, or the nearest to a place [m]."""

PROPERTIES = (
    "pad_stiffness_factor",
    "pad_damping_factor",
    "ballast_stiffness_factor",
    "ballast_damping_factor",
    "gap",
    "fastened",
    "sleeper_mass_factor",
)
"""Columns that say what it has: factors, the gap under its sleeper [m], 1 or 0."""


def read_support_table(path: str, track: Track) -> dict[int, dict[str, float]]:
    """Read what supports have of their own.

    Parameters
    ----------
    path : str
        The file: one row a support, in any order; supports without a row are nominal.
    track : Track
        The track.

    Returns
    -------
    dict of int to dict
        Values by the names of their columns, by support, counted from 0.

    Raises
    ------
    InputError
        For a file that cannot be read, unknown columns, or values that no support has.
    """
    rows = _read_rows(path)
    names = [name.strip() for name in rows[0][1]]
    _check_names(path, names)
    found: dict[int, dict[str, float]] = {}
    for line, cells in rows[1:]:
        where = f"table {path}, line {line}"
        values = _numbers(where, names, cells)
        support = _support(where, values, track)
        if support in found:
            raise InputError(f"{where}: support {support + 1} has a row already; leave one out")
        found[support] = values
    return found


def _read_rows(path: str) -> list[tuple[int, list[str]]]:
    """Return lines with their numbers, those of comments left out."""
    try:
        text = Path(path).read_text(encoding="utf-8-sig")
    except (OSError, ValueError) as error:
        raise InputError(f"table {path}: cannot be read ({error})") from error
    lines = [
        (number, line.replace(";", ","))
        for number, line in enumerate(text.splitlines(), start=1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if not lines:
        raise InputError(f"table {path}: is empty; its first line must name the columns")
    return [(number, next(csv.reader([line]))) for number, line in lines]


def _check_names(path: str, names: Sequence[str]) -> None:
    for name in names:
        if name not in (*PLACES, *PROPERTIES) or names.count(name) > 1:
            raise InputError(
                f"table {path}: column {name!r} is unknown or there twice; its first line must "
                f"name columns of {', '.join((*PLACES, *PROPERTIES))}"
            )
    if sum(name in PLACES for name in names) != 1:
        raise InputError(f"table {path}: must have one of the columns {' and '.join(PLACES)}")


def _numbers(where: str, names: Sequence[str], cells: Sequence[str]) -> dict[str, float]:
    if len(cells) != len(names):
        raise InputError(f"{where}: has {len(cells)} values, not {len(names)} as the first line")
    values = {}
    for name, cell in zip(names, cells, strict=True):
        try:
            value = float(cell)
        except ValueError:
            value = math.nan
        if not (math.isfinite(value) and value >= 0.0):
            raise InputError(f"{where}: {name} is {cell.strip()!r}, not a number of at least 0")
        values[name] = value
    return values


def _support(where: str, values: dict[str, float], track: Track) -> int:
    """Take the place out of a row and return its support, counted from 0."""
    if "number" in values:
        exact = values.pop("number") - 1.0
        if exact != round(exact):
            raise InputError(f"{where}: number is {exact + 1.0:g}, not a whole number")
    else:
        exact = values.pop("position") / track.sleeper_spacing - 1.0
    support = round(exact)
    if not 0 <= support < track.bays - 1:
        raise InputError(
            f"{where}: names support {support + 1} but the track has {track.bays - 1}: correct it "
            "or raise track.bays"
        )
    return support
