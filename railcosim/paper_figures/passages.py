"""The passages behind the figures: both tracks, at many speeds and at one in full."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

from ..errors import InputError, RunError
from ..passage import run_passage
from ..result_check import check_result
from ..scenario_file import to_toml
from ..signals import labels
from ..sweep.ranges import grid_values
from ..sweep.study_file import parse_study

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    import xarray as xr

    from ..scenario import Scenario
    from ..sweep import Study

BALLASTS = ("state_dependent", "linear")
"""The two tracks that are compared."""

SPEED = "vehicle.speed_kmh"
BALLAST = "track.ballast"


def parse_speeds(text: str) -> tuple[float, ...]:
    """Read speeds [km/h] as ``FROM:TO:STEP`` or as numbers between commas.

    Raises
    ------
    InputError
        For a text that is neither, or a speed that occurs twice.
    """
    parts = text.split(":")
    try:
        numbers = [float(part) for part in (parts if len(parts) > 1 else text.split(","))]
    except ValueError:
        numbers = []
    if len(parts) not in {1, 3} or not numbers:
        raise InputError(
            f"--speeds is {text!r} but must be FROM:TO:STEP, as in 5:100:5, or numbers between "
            "commas"
        )
    given = numbers if len(parts) == 1 else dict(zip(("from", "to", "step"), numbers, strict=True))
    return tuple(float(value) for value in grid_values(SPEED, given))


def speed_study(scenario: Scenario, speeds: Sequence[float], fmus: str | None = None) -> Study:
    """Describe the passages of a scenario on both tracks at every speed.

    Parameters
    ----------
    scenario : Scenario
        All the rest.
    speeds : sequence of float
        Speeds [km/h].
    fmus : str, optional
        Which build of the FMUs runs.

    Raises
    ------
    InputError
        For a scenario whose speed is a table, or a speed beyond the limits.
    """
    if scenario.vehicle.speed_table:
        raise InputError(
            "vehicle.speed_table is given but the figures choose the speed: leave it out"
        )
    base = re.sub(r"^\[", "[base.", to_toml(scenario), flags=re.MULTILINE)
    options = f'[base.options]\nfmus = "{fmus}"\n' if fmus else ""
    ballasts = ", ".join(f'"{ballast}"' for ballast in BALLASTS)
    grid = f"[sweep.grid]\n{SPEED} = {list(speeds)}\n{BALLAST} = [{ballasts}]\n"
    return parse_study(f"{base}\n{options}\n{grid}", name="study of the figures")


def peaks_of(result: xr.Dataset) -> xr.Dataset:
    """Return the result of a speed study over ``speed_kmh`` and ``ballast``.

    Raises
    ------
    RunError
        If a passage failed.
    """
    peaks = result.rename({SPEED: "speed_kmh", BALLAST: "ballast"})
    failed = peaks.where(peaks["failure"] != "", drop=True)["failure"].to_series().dropna()
    if len(failed):
        (speed, ballast), reason = next(iter(failed.items()))
        raise RunError(
            f"{len(failed)} passages failed, the first at {speed:g} km/h on the {ballast} track: "
            f"{reason}"
        )
    peaks["speed_kmh"].attrs = labels("km h-1", "speed of the train")
    return peaks


def full_passages(
    scenario: Scenario,
    speed_kmh: float,
    *,
    fmus: str,
    notify: Callable[[str], None] | None = None,
) -> dict[str, xr.Dataset]:
    """Run a scenario on both tracks at one speed and keep everything.

    Parameters
    ----------
    scenario : Scenario
        All but speed and ballast.
    speed_kmh : float
        The speed.
    fmus : str
        Which build of the FMUs runs.
    notify : callable, optional
        Told in a few words what is built.

    Returns
    -------
    dict of str to xarray.Dataset
        By `BALLASTS`.

    Raises
    ------
    RunError
        If a passage fails.
    """
    found = {}
    for ballast in BALLASTS:
        case = replace(
            scenario,
            vehicle=replace(scenario.vehicle, speed_kmh=speed_kmh),
            track=replace(scenario.track, ballast=ballast),
        )
        found[ballast] = run_passage(case, fmus=fmus, notify=notify)
        check_result(found[ballast])
    return found
