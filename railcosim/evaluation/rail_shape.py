"""The displacement of the whole rail, which a result does not hold, from its contact forces."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp
import xarray as xr

from fmu_src.python.track_making import make_track
from track_fmu.contact_point import locate

from ..dataset import count
from ..errors import InputError
from ..motion import speed_law
from ..scenario_file import from_toml
from ..signals import DOWN, FORWARDS
from ..start_values import track_values

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from track_fmu.track_model import TrackModel


def rail_shape(passage: xr.Dataset, times: ArrayLike, positions: ArrayLike) -> xr.DataArray:
    """Work out how the rail is displaced at chosen times and places.

    The track model is loaded once more with the recorded contact forces, step by step as in the
    run, on straight lines between its points. A chosen time within a step is reached by a part of
    that step, so that the others stay what they were. It takes about 0.2 ms per step of the run and
    1 ms per chosen time.

    Parameters
    ----------
    passage : xarray.Dataset
        Result of a passage, also read back from a file.
    times : array_like, shape (n,)
        Increasing times within the run [s].
    positions : array_like, shape (m,)
        Places along the rail [m].

    Returns
    -------
    xarray.DataArray
        Displacement [m], downwards positive, dims (time, rail_position). Its attribute
        ``largest_deviation`` [m] is how far the displacement under a wheel was at most from the
        recorded one: rounding after a run with iterated coupling; more where the track was given
        other forces than the vehicle answered, as by an algorithm that does not iterate.

    Raises
    ------
    InputError
        For a time outside the run or a place beyond the track.
    """
    wanted, places = _checked(passage, times), np.atleast_1d(np.asarray(positions, dtype=float))
    model = track_of(passage)
    interpolation = _interpolation(model, places)
    nodes, deviation = _node_displacements(model, passage, wanted)
    return xr.DataArray(
        nodes @ interpolation.T,
        dims=("time", "rail_position"),
        coords={
            "time": ("time", wanted, passage["time"].attrs),
            "rail_position": (
                "rail_position",
                places,
                {"units": "m", "long_name": "position along the rail", "sign": FORWARDS},
            ),
        },
        name="rail_shape",
        attrs={
            "units": "m",
            "long_name": "displacement of the rail",
            "sign": DOWN,
            "largest_deviation": deviation,
        },
    )


def _node_displacements(
    model: TrackModel, passage: xr.Dataset, wanted: NDArray[np.float64]
) -> tuple[NDArray[np.float64], float]:
    """Drive the model up to the last wanted time.

    Returns
    -------
    ndarray, shape (n, nodes * 2)
        Deflection [m] and rotation [rad] of the rail nodes at the wanted times.
    float
        Largest deviation of the displacement under a wheel from the recorded one [m].
    """
    times = passage["time"].to_numpy()
    positions, forces, recorded = (
        passage[name].transpose("time", "wheel").to_numpy()
        for name in ("wheel_position", "contact_force", "rail_displacement")
    )
    before = np.clip(np.searchsorted(times, wanted) - 1, 0, times.size - 2)
    nodes = np.empty((wanted.size, model.track.ballast_rows.start))
    model.start(positions[0], forces[0])
    deviations = [np.abs(model.rail_displacement - recorded[0]).max()]
    for k in range(before[-1] + 1):
        size = times[k + 1] - times[k]
        for row in range(*np.searchsorted(before, (k, k + 1))):
            share = (wanted[row] - times[k]) / size
            nodes[row] = _after(
                model,
                share * size,
                positions[k] + share * (positions[k + 1] - positions[k]),
                forces[k] + share * (forces[k + 1] - forces[k]),
            )
        model.step(size, positions[k + 1], forces[k + 1])
        deviations.append(np.abs(model.rail_displacement - recorded[k + 1]).max())
    return nodes, float(max(deviations))


def track_of(passage: xr.Dataset) -> TrackModel:
    """Set up the track model of a passage."""
    scenario = from_toml(passage.attrs["scenario"])
    numbers = count(scenario)
    return make_track(
        track_values(scenario, speed_law(scenario.vehicle)),
        bays=scenario.track.bays,
        elements_per_bay=scenario.track.elements_per_bay,
        wheels=numbers["wheel"],
        gauges=numbers["gauge"],
    )


def _checked(passage: xr.Dataset, times: ArrayLike) -> NDArray[np.float64]:
    """Return the chosen times if the run holds them in this order."""
    wanted = np.atleast_1d(np.asarray(times, dtype=float))
    first, last = passage["time"].to_numpy()[[0, -1]]
    outside = ~((wanted >= first) & (wanted <= last))
    if outside.any():
        raise InputError(
            f"the rail is wanted at {wanted[outside][0]:g} s but the run lasts from {first:g} s to "
            f"{last:g} s: choose times in it"
        )
    if (np.diff(wanted) <= 0.0).any():
        raise InputError("the times at which the rail is wanted do not increase: sort them")
    return wanted


def _interpolation(model: TrackModel, places: NDArray[np.float64]) -> sp.csr_array:
    """Return the matrix that turns node displacements into those of the places."""
    parameters = model.track.parameters
    try:
        points = [locate(parameters, float(place)) for place in places]
    except ValueError as error:
        raise InputError(str(error)) from error
    values = [point.shape for point in points]
    columns = [np.arange(point.rows.start, point.rows.stop) for point in points]
    rows = np.repeat(np.arange(places.size), 4)
    return sp.csr_array(
        sp.coo_array(
            (np.ravel(values), (rows, np.ravel(columns))),
            shape=(places.size, model.track.ballast_rows.start),
        )
    )


def _after(
    model: TrackModel,
    duration: float,
    positions: NDArray[np.float64],
    forces: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Return the node displacements after a part of a step, which is then undone."""
    if duration <= 0.0:
        return model.observe().rail_displacement
    before = model.state
    model.step(duration, positions, forces)
    displacement = model.observe().rail_displacement
    model.state = before
    return displacement
