"""Numeric tables in CSV files: measured profiles, irregularities, speeds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray


def read_table(
    path: str | Path, columns: Sequence[str], *, optional: Sequence[str] = ()
) -> dict[str, NDArray[np.float64]]:
    """Read a table of numbers.

    Values are separated by commas, semicolons or white space; empty lines and lines that start
    with ``#`` are passed over; one line of column names may come first.

    Parameters
    ----------
    path : str or Path
        The file.
    columns : sequence of str
        Names of the columns in the order in which the file has them.
    optional : sequence of str
        Columns that may follow them; the first row of numbers says how many do.

    Returns
    -------
    dict of (rows,) float array
        One array a column, all values finite.

    Raises
    ------
    ValueError
        If the file cannot be read, a line has decimal commas or the wrong number of values or a
        value is not a finite number; the message names file and line.
    """
    text = read_text(path)
    rows: list[list[float]] = []
    names = list(columns)
    header_allowed = True
    for number, line in enumerate(text.splitlines(), start=1):
        content = line.strip()
        if not content or content.startswith("#"):
            continue
        cells = content.replace(";", ",").split(",") if _has_separator(content) else content.split()
        if header_allowed and not any(_is_number(cell) for cell in cells):
            header_allowed = False
            continue
        header_allowed = False
        if "," in content and ";" in content:
            raise ValueError(
                f"table {path}, line {number}: has both commas and semicolons; write decimals with "
                "a point"
            )
        if not rows:
            names += optional[: max(0, len(cells) - len(columns))]
        rows.append(_numbers(cells, names, f"table {path}, line {number}"))
    if not rows:
        raise ValueError(f"table {path}: has no rows; expected columns {', '.join(columns)}")
    values = np.array(rows)
    return {name: values[:, i].copy() for i, name in enumerate(names)}


def read_text(path: str | Path) -> str:
    """Text of a file without its byte order mark.

    Raises
    ------
    ValueError
        If there is none.
    """
    try:
        data = Path(path).read_bytes()
    except OSError as error:
        raise ValueError(f"table {path}: cannot be read ({error.strerror})") from error
    zero = data.find(0)
    if zero >= 0:
        raise ValueError(
            f"table {path}: byte {zero + 1} is zero, which is no text; save the table as UTF-8"
        )
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise ValueError(f"table {path}: cannot be read (it is not UTF-8 text)") from error


def _has_separator(content: str) -> bool:
    return "," in content or ";" in content


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _numbers(cells: Sequence[str], columns: Sequence[str], where: str) -> list[float]:
    """Values of one line."""
    if len(cells) != len(columns):
        raise ValueError(
            f"{where}: has {len(cells)} values, not {len(columns)} ({', '.join(columns)})"
        )
    numbers = []
    for cell, column in zip(cells, columns, strict=True):
        if not _is_number(cell) or not math.isfinite(float(cell)):
            raise ValueError(f"{where}: {column} is {cell.strip()!r}, not a finite number")
        numbers.append(float(cell))
    return numbers
