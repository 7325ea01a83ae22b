"""What is fixed when an FMU is built: which pair it belongs to, and its size."""

from __future__ import annotations

from dataclasses import dataclass, fields

from .python.packaging import RECIPES

PAIRS = {"vehicle": ("track", "vehicle"), "track": ("track_contact", "masses")}
"""Kinds of the FMUs of track and vehicle by the side that has the contacts."""

TRACKS = {track for track, _ in PAIRS.values()}
TRACK_SIZE = ("bays", "elements_per_bay", "wheels", "gauges")
VEHICLE_SIZE = ("wheels", "bogies")


@dataclass(frozen=True, slots=True, kw_only=True)
class Structure:
    """What is fixed when an FMU is built.

    Parameters
    ----------
    bays, elements_per_bay : int
        Size of the track.
    wheels : int
        Number of wheels.
    gauges : int
        Number of bending moment gauges.
    bogies : int
        Number of bogies, which share the wheels.

    Raises
    ------
    ValueError
        If a number is too small.
    """

    bays: int = 50
    elements_per_bay: int = 8
    wheels: int = 2
    gauges: int = 3
    bogies: int = 1

    def __post_init__(self) -> None:
        for name, least in (
            ("bays", 2),
            ("elements_per_bay", 1),
            ("wheels", 1),
            ("gauges", 0),
            ("bogies", 1),
        ):
            if getattr(self, name) < least:
                raise ValueError(f"{name} is {getattr(self, name)}; it must be at least {least}")
        if self.wheels % self.bogies:
            raise ValueError(
                f"{self.wheels} wheels cannot be shared out among {self.bogies} bogies; give every "
                "bogie as many"
            )

    def of(self, kind: str) -> dict[str, int]:
        """The part that matters to the FMU of a kind."""
        names = TRACK_SIZE if kind in TRACKS else VEHICLE_SIZE
        return {name: getattr(self, name) for name in names}

    def file_name(self, kind: str) -> str:
        """File name of the FMU of a kind; the default structure has the plain name."""
        defaults = {field.name: field.default for field in fields(self)}
        changed = {k: v for k, v in self.of(kind).items() if v != defaults[k]}
        suffix = "".join(f"-{value}{name.replace('_', '-')}" for name, value in changed.items())
        return f"{RECIPES[kind].name}{suffix}.fmu"
