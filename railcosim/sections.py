"""The small sections of a scenario file: every key with its unit, default and limits."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from .field_rules import Choice, Number, is_csv
from .fields import check_fields


@dataclass(frozen=True, slots=True, kw_only=True)
class Flat:
    """Keys of ``[flat]``: the wheel flat and the place where it meets the rail.

    Attributes
    ----------
    shape : str
        ``haversine``, ``parabola``, ``cusp``, ``chord``, ``none`` or a CSV file.
    length, depth : float
        Independent of each other [m]; a chord's depth follows from its length, and a CSV file
        brings both.
    wheel : int
        Wheel that has the flat, 1 leads.
    position : float, optional
        Rail position where the flat's centre meets the rail [m]; 25 mm behind the middle of bay
        ``bays // 2 + 1`` where none is given.
    periodic : bool
        Whether the flat strikes once per turn of the wheel, or once.
    rolled : bool
        Whether the round rail is rolled over the profile, or the profile is used as it is.
    """

    shape: Annotated[
        str, Choice(("haversine", "parabola", "cusp", "chord", "none"), or_csv=True)
    ] = "haversine"
    length: Annotated[float, Number(unit="m", above=0.0)] = 0.1
    depth: Annotated[float, Number(unit="m", at_least=0.0, at_most=0.02)] = 0.9e-3
    wheel: Annotated[int, Number(at_least=1)] = 1
    position: Annotated[float | None, Number(unit="m")] = None
    periodic: bool = False
    rolled: bool = False

    def __post_init__(self) -> None:
        check_fields(self, "flat")

    @property
    def is_measured(self) -> bool:
        """Whether the shape is a CSV file."""
        return is_csv(self.shape)


@dataclass(frozen=True, slots=True, kw_only=True)
class Run:
    """Keys of ``[run]``: how far the flat's wheel rolls.

    Attributes
    ----------
    approach, departure : float
        Distance rolled before and after the flat's centre meets the rail [m].
    """

    approach: Annotated[float, Number(unit="m", above=0.0)] = 3.9
    departure: Annotated[float, Number(unit="m", above=0.0)] = 2.6

    def __post_init__(self) -> None:
        check_fields(self, "run")


@dataclass(frozen=True, slots=True, kw_only=True)
class Surface:
    """Keys of ``[surface]``: how the tables of irregularities and wheel defects are used.

    Attributes
    ----------
    ramp : float
        Distance over which the irregularities of the rail set in, from the start of the leading
        wheel [m].
    contact_filter : bool
        Whether waves are weakened that are not much longer than the contact patch; flats and
        spalls are left as they are.
    """

    ramp: Annotated[float, Number(unit="m", at_least=0.0)] = 1.0
    contact_filter: bool = False

    def __post_init__(self) -> None:
        check_fields(self, "surface")
