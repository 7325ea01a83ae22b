"""The files from which the FMUs read what rail and wheels are uneven by."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from .errors import InputError

if TYPE_CHECKING:
    from .scenario import Scenario


@dataclass(frozen=True, slots=True, kw_only=True)
class SurfaceFiles:
    """Paths that the FMUs are given.

    Attributes
    ----------
    rail : str
        Empty for a smooth rail.
    treads : tuple of str
        One a wheel, empty for a round one.
    """

    rail: str
    treads: tuple[str, ...]


def files_of(scenario: Scenario) -> SurfaceFiles:
    """Return the files of a scenario that needs none but those that it names.

    Raises
    ------
    InputError
        For a scenario whose surfaces have to be composed first.
    """
    if scenario.irregularity or scenario.wheel_defect:
        raise InputError(
            "the tables [[irregularity]] and [[wheel_defect]] are composed for a run and are no "
            "part of a package: write them with railcosim irregularity and name their files"
        )
    return SurfaceFiles(
        rail=scenario.vehicle.rail_irregularity, treads=("",) * scenario.vehicle.wheels
    )
