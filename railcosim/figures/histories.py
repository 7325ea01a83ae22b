"""Histories of one strike on both tracks, side by side."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from .passage import SPAN
from .speed import MARKERS
from .style import QUIET, tidy

if TYPE_CHECKING:
    from collections.abc import Mapping

    import xarray as xr
    from matplotlib.axes import Axes


def draw_histories(passages: Mapping[str, xr.Dataset]) -> Figure:
    """Draw contact force, sleeper displacement and bending moment over time.

    Parameters
    ----------
    passages : mapping of str to xarray.Dataset
        The same passage on either track, by the kind of ballast.

    Returns
    -------
    matplotlib.figure.Figure
        Three panels; time counts from when the flat's centre meets the rail.
    """
    figure = Figure(figsize=(8.0, 9.0), layout="constrained")
    force, sleeper, moment = figure.subplots(3, 1, sharex=True)
    for ballast, passage in passages.items():
        _draw(passage, (force, sleeper, moment), ballast)
    some = next(iter(passages.values()))
    static = 1e-3 * float(some["static_wheel_load"])
    force.axhline(static, color=QUIET, linestyle="--", linewidth=1.0, label="static load")
    force.set_ylabel("contact force\nof the flat's wheel [kN]")
    force.set_ylim(bottom=0.0)
    sleeper.set_ylabel("displacement of the sleeper\nthat moves most, downwards [mm]")
    sleeper.invert_yaxis()
    moment.set_ylabel("bending moment in the middle\nof the struck bay, sagging [kN m]")
    moment.set_xlabel("time since the flat's centre met the rail [ms]")
    for axes in (force, sleeper, moment):
        axes.axvline(0.0, color=QUIET, linewidth=0.8, zorder=0)
        tidy(axes)
    return figure


def _draw(passage: xr.Dataset, panels: tuple[Axes, Axes, Axes], ballast: str) -> None:
    """Draw one track into all panels."""
    distance = passage["distance"].to_numpy()
    strike = float(np.interp(0.0, distance, passage["time"].to_numpy()))
    drawn = passage.isel(time=(distance >= SPAN[0]) & (distance <= SPAN[1]))
    time = 1e3 * (drawn["time"] - strike)
    displacement = passage["sleeper_displacement"]
    most = int(displacement.max("time").idxmax("sleeper"))
    histories = (
        1e-3 * drawn["contact_force"].sel(wheel=drawn["flat_wheel"]),
        1e3 * drawn["sleeper_displacement"].sel(sleeper=most),
        1e-3 * drawn["bending_moment"].isel(gauge=0),
    )
    _, colour = MARKERS[ballast]
    for axes, history in zip(panels, histories, strict=True):
        axes.plot(time, history, color=colour, label=f"{ballast.replace('_', '-')} track")
