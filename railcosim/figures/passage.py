"""The picture of one passage."""

from __future__ import annotations

from itertools import cycle
from pathlib import Path
from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from ..contact_loss import contact_losses
from ..field_rules import is_csv
from ..scenario_file import from_toml
from .style import BLUE, OTHERS, QUIET, tidy

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

    from ..scenario import Scenario
    from ..sections import Flat

SPAN = (-0.5, 1.0)
"""Part of the run that is drawn of a single strike: the flat's wheel from the flat's centre [m]."""


def draw_passage(passage: xr.Dataset) -> Figure:
    """Draw contact forces, displacements and bending moments over the distance from the flat.

    Parameters
    ----------
    passage : xarray.Dataset
        Result of a passage, also read back from a file.

    Returns
    -------
    matplotlib.figure.Figure
        Three panels above each other; save it in the format wanted.
    """
    scenario = from_toml(passage.attrs["scenario"])
    drawn = passage
    if strikes_once(scenario):
        distance = passage["distance"]
        drawn = passage.isel(time=((distance >= SPAN[0]) & (distance <= SPAN[1])).to_numpy())
    figure = Figure(figsize=(8.0, 9.0), layout="constrained")
    force, displacement, moment = figure.subplots(3, 1, sharex=True)
    _draw_forces(force, drawn)
    _draw_displacements(displacement, drawn)
    _draw_moments(moment, drawn)
    for axes in (force, displacement, moment):
        axes.axvline(0.0, color=QUIET, linewidth=0.8, zorder=0)
        tidy(axes)
    moment.set_xlabel(_distance_label(scenario, float(passage["flat_position"])))
    figure.suptitle(describe(scenario))
    return figure


def _distance_label(scenario: Scenario, position: float) -> str:
    """Say what distances count from: the flat, or the place named where there is none."""
    if scenario.flat.shape == "none":
        return f"distance of wheel {scenario.flat.wheel} from {position:g} m along the rail [m]"
    return "distance of the flat's wheel from the flat's centre [m]"


def describe(scenario: Scenario) -> str:
    """Say in one line which passage a scenario is."""
    vehicle, flat = scenario.vehicle, scenario.flat
    speed = "speed table" if vehicle.speed_table else f"{3.6 * vehicle.constant_speed:g} km/h"
    wheel = (
        "round wheels"
        if flat.shape == "none"
        else f"{describe_flat(flat)} flat on wheel {flat.wheel}"
    )
    is_uneven = vehicle.rail_irregularity or scenario.irregularity
    rail = ", rail irregularity" if is_uneven else ""
    treads = ", wheel defects" if scenario.wheel_defect else ""
    ballast = scenario.track.ballast
    track = Path(ballast).name if is_csv(ballast) else ballast.replace("_", "-")
    return f"{speed}, {wheel}{treads}{rail}, {track} track"


def strikes_once(scenario: Scenario) -> bool:
    """Whether all that happens is one strike of the flat."""
    flat = scenario.flat
    return flat.shape != "none" and not flat.periodic and scenario.is_smooth


def describe_flat(flat: Flat) -> str:
    """Say which flat it is by the parameters that its shape uses."""
    kinds = "".join(f"{word} " for word in ("periodic", "rolled") if getattr(flat, word))
    if flat.is_measured:
        return f"{kinds}measured"
    length = f"{1e3 * flat.length:g} mm"
    return f"{kinds}{flat.shape} {length}" + (
        "" if flat.shape == "chord" else f" x {1e3 * flat.depth:g} mm"
    )


def wheel_colours(drawn: xr.Dataset) -> dict[int, str]:
    """Give every wheel a colour, the flat's wheel always the same."""
    others = cycle(OTHERS)
    flat_wheel = int(drawn["flat_wheel"])
    return {
        int(wheel): BLUE if wheel == flat_wheel else next(others)
        for wheel in drawn["wheel"].to_numpy()
    }


def _draw_forces(axes: Axes, drawn: xr.Dataset) -> None:
    """Draw the contact force of every wheel, the static load, and where the flat's wheel is off."""
    x, flat_wheel = drawn["distance"], int(drawn["flat_wheel"])
    for wheel, colour in wheel_colours(drawn).items():
        force = 1e-3 * drawn["contact_force"].sel(wheel=wheel)
        axes.plot(x, force, color=colour, label=f"wheel {wheel}")
    static = 1e-3 * float(drawn["static_wheel_load"])
    axes.axhline(static, color=QUIET, linestyle="--", linewidth=1.0, label="static load")
    gap = drawn["gap"].sel(wheel=flat_wheel).to_numpy()
    for k, (start, end) in enumerate(contact_losses(x.to_numpy(), gap)):
        label = f"wheel {flat_wheel} off the rail" if k == 0 else None
        axes.axvspan(start, end, color=BLUE, alpha=0.15, linewidth=0.0, label=label)
    axes.set_ylabel("contact force [kN]")
    axes.set_ylim(bottom=0.0)


def _draw_displacements(axes: Axes, drawn: xr.Dataset) -> None:
    """Draw, downwards as they are, the rail under every wheel and the sleeper that moves most."""
    x = drawn["distance"]
    for wheel, colour in wheel_colours(drawn).items():
        rail = 1e3 * drawn["rail_displacement"].sel(wheel=wheel)
        axes.plot(x, rail, color=colour, label=f"rail under wheel {wheel}")
    largest = 1e3 * drawn["sleeper_displacement"].max("sleeper")
    axes.plot(x, largest, color="black", linewidth=1.0, label="sleeper that moves most")
    axes.set_ylabel("displacement, downwards [mm]")
    axes.invert_yaxis()


def _draw_moments(axes: Axes, drawn: xr.Dataset) -> None:
    """Draw the bending moment under the flat's wheel and in the middle of the struck bay."""
    x, wheel = drawn["distance"], int(drawn["flat_wheel"])
    under = 1e-3 * drawn["bending_moment_under_wheel"].sel(wheel=wheel)
    axes.plot(x, under, color=BLUE, label=f"under wheel {wheel}")
    midspan = 1e-3 * drawn["bending_moment"].isel(gauge=0)
    axes.plot(x, midspan, color="black", linewidth=1.0, label="middle of the struck bay")
    axes.set_ylabel("bending moment, sagging [kN m]")
