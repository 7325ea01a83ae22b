"""The files from which the FMUs read what rail, wheels and endless supports have of their own."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..errors import InputError

if TYPE_CHECKING:
    from ..scenario import Scenario


@dataclass(frozen=True, slots=True, kw_only=True)
class SurfaceFiles:
    """Paths that the FMUs are given.

    Attributes
    ----------
    rail : str
        Empty for a smooth rail.
    treads : tuple of str
        One a wheel, empty for a round one.
    supports : str
        Of an endless track; empty where its supports are alike. An ordinary track has parameters
        for every one of them.
    """

    rail: str
    treads: tuple[str, ...]
    supports: str = ""


def files_of(scenario: Scenario) -> SurfaceFiles:
    """Return the files of a scenario that needs none but those that it names.

    Raises
    ------
    InputError
        For a scenario whose surfaces or supports have to be composed first.
    """
    if scenario.irregularity or scenario.wheel_defect:
        raise InputError(
            "the tables [[irregularity]] and [[wheel_defect]] are composed for a run and are no "
            "part of a package: write them with railcosim irregularity and name their files"
        )
    if scenario.track.endless and scenario.variation.is_any:
        raise InputError(
            "[variation] on an endless track is written for a run and is no part of a package: "
            "name a file of supports as track.supports"
        )
    return SurfaceFiles(
        rail=scenario.vehicle.rail_irregularity,
        treads=("",) * scenario.vehicle.wheels,
        supports=scenario.track.supports if scenario.track.endless else "",
    )
