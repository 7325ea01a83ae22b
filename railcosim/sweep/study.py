"""A study: a scenario, the keys of it that are swept, and what is kept of every case."""

from __future__ import annotations

import math
from copy import deepcopy
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import InputError
from ..fields import holds_float
from ..keep_section import Keep
from ..scenario_file import SECTIONS, Values, build_scenario, no_values, put
from .case import Case, Options
from .ranges import MOST_CASES

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from .case import Swept

OPTIONS = ("contact", "fmus")
"""Keys of ``options``."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Base:
    """What all cases have in common.

    Attributes
    ----------
    values : dict
        Keys of the scenario by section.
    options : mapping of str to object
        Keys of ``options``.
    """

    values: Values = field(default_factory=no_values)
    options: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class Study:
    """Every combination of the rows with the points of the grid is a case.

    Attributes
    ----------
    text, base_text : str
        The study file, and the scenario file that it names, for the result.
    folder : Path
        Where files that swept keys name are sought.
    base : Base
        What all cases have in common.
    grid : mapping of str to tuple
        Values of ``section.key``; every key is a dimension of the result.
    rows : tuple of mapping of str to value
        Cases that were listed or drawn, with the same keys each; empty for a mere grid.
    keep : Keep
        Which histories every case keeps; none without signals.

    Raises
    ------
    InputError
        For a key that is swept twice, for too many cases or none.
    """

    text: str = ""
    base_text: str = ""
    folder: Path = field(default_factory=Path.cwd)
    base: Base = field(default_factory=Base)
    grid: Mapping[str, tuple[Swept, ...]] = field(default_factory=dict)
    rows: tuple[Mapping[str, Swept], ...] = ()
    keep: Keep = field(default_factory=Keep)

    def __post_init__(self) -> None:
        if not (self.grid or self.rows):
            raise InputError(
                "the study sweeps nothing: give [sweep.grid], [[sweep.list]] or [sweep.random]"
            )
        twice = [key for key in self.grid if key in self.row_keys]
        if twice:
            raise InputError(f"{twice[0]} is swept twice, by the grid too: leave it out of one")
        if len(self) > MOST_CASES:
            raise InputError(f"the study has {len(self)} cases but at most {MOST_CASES} can be run")

    def __len__(self) -> int:
        """Number of cases."""
        return math.prod(self.shape)

    @property
    def row_keys(self) -> tuple[str, ...]:
        """Keys of the rows."""
        return tuple(self.rows[0]) if self.rows else ()

    @property
    def dims(self) -> tuple[str, ...]:
        """Dimensions of the result: ``case`` for the rows, then the keys of the grid."""
        return (*(("case",) if self.rows else ()), *self.grid)

    @property
    def shape(self) -> tuple[int, ...]:
        """Lengths of the dimensions."""
        rows = (len(self.rows),) if self.rows else ()
        return (*rows, *(len(values) for values in self.grid.values()))

    def case(self, index: int) -> Case:
        """Return a case, counted from 0; the last key of the grid changes first.

        Raises
        ------
        InputError
            For a key or a value that does not fit; the message begins with the case.
        """
        place = [int(n) for n in np.unravel_index(index, self.shape)]
        swept = dict(self.rows[place.pop(0)]) if self.rows else {}
        swept |= {key: self.grid[key][n] for key, n in zip(self.grid, place, strict=True)}
        values = deepcopy(self.base.values) | {"keep": asdict(self.keep)}
        options = dict(self.base.options)
        try:
            for name, value in swept.items():
                place_key(values, options, name, value, self.folder)
            scenario = build_scenario(values)
            chosen = Options(**options).resolved()
        except InputError as error:
            keys = ", ".join(f"{key} = {value}" for key, value in swept.items())
            raise InputError(f"case {index + 1} ({keys}): {error}") from error
        return Case(number=index + 1, swept=swept, scenario=scenario, options=chosen)

    def cases(self) -> Iterator[Case]:
        """Yield every case."""
        return map(self.case, range(len(self)))


def place_key(
    values: Values, options: dict[str, Any], name: str, value: object, folder: Path
) -> None:
    """Put the value of ``section.key`` into a scenario's keys or into the options.

    Raises
    ------
    InputError
        For an unknown key.
    """
    section, _, key = name.partition(".")
    if section == "keep":
        raise InputError(f"{name} is the same for all cases: give it in the table [keep]")
    if section != "options":
        put(values, section, key, value, folder)
    elif key in OPTIONS:
        options[key] = value
    else:
        raise InputError(f"options.{key} is no option of a case, which are {', '.join(OPTIONS)}")


def coordinate(name: str, values: tuple[Swept, ...]) -> np.ndarray[Any, np.dtype[Any]]:
    """Return the values of a swept key as an array of the key's own type, shape (n,)."""
    section, _, key = name.partition(".")
    if section in SECTIONS and holds_float(SECTIONS[section], key):
        return np.array(values, dtype=float)
    return np.array(values)
