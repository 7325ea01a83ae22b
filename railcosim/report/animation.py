"""The data of the animation: the rail under the wheels around the strike."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..evaluation.rail_shape import rail_shape
from ..figures.passage import SPAN, strikes_once, wheel_colours
from ..scenario_file import from_toml
from .embedding import packed
from .plot import thinned

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

REACH = 3.0
"""Length of rail that is shown before and after the flat's place [m]."""

SPACING = 0.05
"""Distance of the points that a rail is drawn through [m]."""

RATE = 2000.0
"""Frames per simulated second: twice the rail's pinned-pinned resonance [Hz]."""

MOST_FRAMES = 1000
"""Frames of a slow or long passage, whose rate is lower then."""

MOST_CURVE_POINTS = 3000
"""Points of the force beside the rail."""

SHORTEST = 20
"""Frames that make an animation."""


def animate(passage: xr.Dataset) -> dict[str, Any] | None:
    """Sample the rail, the sleepers and the wheels around the strike.

    Parameters
    ----------
    passage : xarray.Dataset
        Result of a passage.

    Returns
    -------
    dict or None
        Packed arrays, those over frames in rows of one frame; lengths in metres, displacements in
        millimetres, forces in kilonewtons; None where the run ended before there was anything to
        show, and on an endless track, of which a result holds no whole rail.
    """
    scenario = from_toml(passage.attrs["scenario"])
    if scenario.track.endless:
        return None
    times = frame_times(passage, whole=not strikes_once(scenario))
    if times.size < SHORTEST:
        return None
    place, length = scenario.flat_position, scenario.track.length
    start, end = max(0.0, place - REACH), min(length, place + REACH)
    rail_points = np.linspace(start, end, round((end - start) / SPACING) + 1)
    shape = rail_shape(passage, times, rail_points)
    sleepers = passage["sleeper_position"].to_numpy()
    shown = np.flatnonzero((sleepers >= start) & (sleepers <= end))
    clock = passage["time"].to_numpy()

    def at_frames(name: str) -> NDArray[np.float64]:
        return _sampled(times, clock, passage[name].to_numpy())

    force = passage["contact_force"].to_numpy()
    inside = (clock >= times[0]) & (clock <= times[-1])
    flat = scenario.flat.wheel - 1
    curve = np.flatnonzero(inside)[thinned(force[inside, flat], MOST_CURVE_POINTS)]
    peak = int(np.abs(times - clock[curve][force[curve, flat].argmax()]).argmin())
    return {
        "rate": 1.0 / float(times[1] - times[0]),
        "frames": times.size,
        "peak": peak,
        "time": packed(times),
        "distance": packed(_sampled(times, clock, passage["distance"].to_numpy())),
        "strike": float(np.interp(0.0, passage["distance"], clock)),
        "place": place,
        "railX": packed(rail_points),
        "rail": packed(1e3 * shape.to_numpy()),
        "deviation": 1e3 * float(shape.attrs["largest_deviation"]),
        "sleeperX": packed(sleepers[shown]),
        "sleeper": packed(1e3 * at_frames("sleeper_displacement")[:, shown]),
        "wheels": scenario.vehicle.wheels,
        "flatWheel": flat if scenario.flat.shape != "none" else -1,
        "flatLength": scenario.flat.length,
        "radius": scenario.vehicle.wheel_radius,
        "colours": list(wheel_colours(passage).values()),
        "wheelX": packed(at_frames("wheel_position")),
        "gap": packed(1e3 * at_frames("gap")),
        "force": packed(1e-3 * at_frames("contact_force")),
        "static": 1e-3 * scenario.vehicle.static_wheel_load,
        "curveTime": packed(clock[curve]),
        "curveForce": packed(1e-3 * force[curve]),
    }


def frame_times(passage: xr.Dataset, *, whole: bool) -> NDArray[np.float64]:
    """Return equally spaced times around the strike, or of the whole run [s]."""
    time, distance = passage["time"].to_numpy(), passage["distance"].to_numpy()
    start, end = np.interp((distance[0], distance[-1]) if whole else SPAN, distance, time)
    number = min(MOST_FRAMES, 1 + int(RATE * (end - start)))
    return np.asarray(np.linspace(start, end, number), dtype=float)


def _sampled(
    times: NDArray[np.float64], clock: NDArray[np.float64], values: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Interpolate one or several series at the times of the frames."""
    if values.ndim == 1:
        return np.interp(times, clock, values)
    return np.stack([np.interp(times, clock, column) for column in values.T], axis=1)
