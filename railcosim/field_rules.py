"""Rules for what a key of a scenario file may hold; they stand in the annotations of its field."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

LONGEST_NUMBER = 8
"""Digits of a number in a list from which on it counts nothing that there is."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Number:
    """Limits and unit of a numeric key; booleans and texts are no numbers.

    Attributes
    ----------
    unit : str
        Unit shown in messages, empty for a pure number.
    above, at_least, at_most : float, optional
        Limits; ``above`` is exclusive.
    """

    unit: str = ""
    above: float | None = None
    at_least: float | None = None
    at_most: float | None = None

    def show(self, value: float) -> str:
        """Write ``value`` with the unit."""
        return f"{value:.6g} {self.unit}".rstrip()

    def complaint(self, value: float) -> str | None:
        """Say which limit ``value`` breaks, or None.

        Returns
        -------
        str or None
            The end of a sentence that begins with "must be".
        """
        if not math.isfinite(value):
            return "a finite number"
        if self.above is not None and value <= self.above:
            return f"above {self.show(self.above)}"
        if self.at_least is not None and value < self.at_least:
            return f"at least {self.show(self.at_least)}"
        if self.at_most is not None and value > self.at_most:
            return f"at most {self.show(self.at_most)}"
        return None


@dataclass(frozen=True, slots=True)
class Choice:
    """A text key with a few allowed values.

    Attributes
    ----------
    values : tuple of str
        The allowed texts.
    or_csv : bool
        Whether the path of a .csv file is allowed too.
    """

    values: tuple[str, ...]
    or_csv: bool = False

    def complaint(self, value: str) -> str | None:
        """Say what is allowed where ``value`` is not, or None."""
        if value in self.values or (self.or_csv and is_csv(value)):
            return None
        return "one of " + ", ".join(self.values) + (" or a FILE.csv" if self.or_csv else "")


@dataclass(frozen=True, slots=True)
class CsvFile:
    """A text key that holds the path of a .csv file; empty means no file."""

    def complaint(self, value: str) -> str | None:
        """Say that ``value`` is no CSV path, or None."""
        return None if not value or is_csv(value) else "the path of a .csv file"


@dataclass(frozen=True, slots=True)
class Numbers:
    """A text key with whole numbers from 1 on and ranges of them: ``3, 7-9``; may be empty."""

    def complaint(self, value: str) -> str | None:
        """Say that ``value`` is no such list, or None."""
        wanted = "whole numbers from 1 on and ranges of them, as 3, 7-9"
        parts = [part.strip() for part in value.split(",")] if value.strip() else []
        for part in parts:
            ends = [end.strip() for end in part.split("-")]
            if not all(end.isdecimal() and len(end) < LONGEST_NUMBER for end in ends):
                return wanted
            if len(ends) > len(("first", "last")) or not 0 < int(ends[0]) <= int(ends[-1]):
                return wanted
        return None

    @staticmethod
    def read(value: str) -> list[range]:
        """Return the ranges of a list without complaint, a number being one of length 1."""
        ends = [part.split("-") for part in value.split(",") if part.strip()]
        return [range(int(end[0]), int(end[-1]) + 1) for end in ends]


def is_csv(value: str) -> bool:
    """Tell whether a text names a CSV file."""
    return Path(value).suffix.lower() == ".csv"
