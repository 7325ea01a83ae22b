"""The result of a passage: labelled arrays with their meaning, and how they came about."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from .run_record import ATTEMPT_COLUMNS
from .scenario_file import to_toml
from .signals import COMPRESSION, FORWARDS, labels, signals_of
from .surfaces.dataset import surface_dataset

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from numpy.typing import NDArray

    from .scenario import Scenario
    from .signals import Dimension, Signal
    from .surfaces.tables import UnevenSurfaces


def count(scenario: Scenario) -> dict[Dimension, int]:
    """Return how many wheels, sleepers and gauges a passage has, and bogies if they may move."""
    numbers: dict[Dimension, int] = {
        "wheel": scenario.vehicle.wheels,
        "sleeper": scenario.track.bays - 1,
        "gauge": len(scenario.gauge_positions),
    }
    if scenario.vehicle.is_suspended:
        numbers |= {"bogie": scenario.vehicle.bogies, "car": 1}
    return numbers


def assemble(
    scenario: Scenario,
    *,
    times: NDArray[np.float64],
    series: Mapping[str, NDArray[np.float64]],
    attempts: Mapping[str, NDArray[np.generic]],
    attributes: Mapping[str, str | int | float],
    surfaces: UnevenSurfaces | None = None,
) -> xr.Dataset:
    """Label the records of a run.

    Parameters
    ----------
    scenario : Scenario
        What was run.
    times : ndarray, shape (n,)
        Accepted times [s].
    series : mapping of str to ndarray
        Every one of `signals_of` the scenario by name, of shape (n, wheels), (n, sleepers) or
        (n, gauges).
    attempts : mapping of str to ndarray
        The columns `ATTEMPT_COLUMNS` of the step log, each of shape (m,); causes are texts.
    attributes : mapping
        Versions, identities of the FMUs, statistics.
    surfaces : UnevenSurfaces, optional
        What the wheels rolled over besides the flat.

    Returns
    -------
    xarray.Dataset
        Dimensions ``time``, ``wheel``, ``sleeper``, ``gauge`` and ``attempt``, with a suspended
        vehicle ``bogie`` and ``car``, where surfaces are uneven ``rail_position`` and
        ``tread_angle``; units, long name and sign on every variable.
    """
    flat = series["wheel_position"][:, scenario.flat.wheel - 1]
    labelled = label_series(
        scenario,
        signals_of(scenario),
        times=times,
        distance=flat - scenario.flat_position,
        series=series,
    )
    result = labelled.assign(attempt_variables(attempts)).assign(constants(scenario))
    result.attrs = general_attributes(scenario) | dict(attributes)
    return with_surfaces(result, surfaces)


def label_series(
    scenario: Scenario,
    signals: Iterable[Signal],
    *,
    times: NDArray[np.float64],
    distance: NDArray[np.float64],
    series: Mapping[str, NDArray[np.float64]],
) -> xr.Dataset:
    """Label time series and what they are over.

    Parameters
    ----------
    scenario : Scenario
        What was run.
    signals : iterable of Signal
        Which series.
    times, distance : ndarray, shape (n,)
        Times [s], and where the flat's wheel is then, from the flat's centre [m].
    series : mapping of str to ndarray
        Each of the signals by name, of shape (n, wheels), (n, sleepers) or (n, gauges).
    """
    variables = {
        signal.name: (
            ("time", signal.dim),
            series[signal.name].astype(bool if signal.name == "in_contact" else float),
            signal.attributes,
        )
        for signal in signals
    }
    return xr.Dataset(variables, coords=_coordinates(scenario, times, distance))


def general_attributes(scenario: Scenario) -> dict[str, str]:
    """Return the attributes that say what a result is."""
    return {
        "Conventions": "CF-1.11",
        "title": "Passage of wheels over a discretely supported rail",
        "scenario": to_toml(scenario),
    }


def with_surfaces(result: xr.Dataset, surfaces: UnevenSurfaces | None) -> xr.Dataset:
    """Add what the wheels rolled over besides the flat, where there was anything."""
    if surfaces is None or surfaces.are_smooth:
        return result
    return result.merge(surface_dataset(surfaces), join="exact", compat="no_conflicts")


def attempt_variables(attempts: Mapping[str, NDArray[np.generic]]) -> dict[str, object]:
    """Label the step log.

    Parameters
    ----------
    attempts : mapping of str to ndarray, shape (m,)
        The columns `ATTEMPT_COLUMNS`.
    """
    return {
        f"attempt_{name}": (
            "attempt",
            attempts[name],
            labels(units, meaning),
            # Texts of a fixed length take an eighth of the memory to write.
            {"dtype": "S1"} if name == "cause" else {},
        )
        for name, (units, meaning) in ATTEMPT_COLUMNS.items()
    }


def _coordinates(
    scenario: Scenario, times: NDArray[np.float64], distance: NDArray[np.float64]
) -> dict[str, object]:
    """Label the dimensions by numbers from 1, and by the positions they stand for."""
    numbers = {
        dim: (dim, np.arange(1, n + 1), labels("1", f"number of the {dim}"))
        for dim, n in count(scenario).items()
    }
    spacing = scenario.track.sleeper_spacing
    sleepers = spacing * (scenario.first_bay + np.arange(1, scenario.track.bays))
    gauges = np.array(scenario.gauge_positions)
    return numbers | {
        "time": ("time", times, labels("s", "time since the start of the run")),
        "distance": (
            "time",
            distance,
            labels("m", "distance of the flat's wheel from the flat's centre", FORWARDS),
        ),
        "sleeper_position": (
            "sleeper",
            sleepers,
            labels("m", "position of the sleeper along the rail", FORWARDS),
        ),
        "gauge_position": (
            "gauge",
            gauges,
            labels("m", "position of the gauge along the rail", FORWARDS),
        ),
    }


def constants(scenario: Scenario) -> dict[str, object]:
    """Name what the series are measured against."""
    return {
        "flat_wheel": ((), scenario.flat.wheel, labels("1", "number of the flat's wheel")),
        "flat_position": (
            (),
            scenario.flat_position,
            labels("m", "position where the flat's centre meets the rail", FORWARDS),
        ),
        "static_wheel_load": (
            (),
            scenario.vehicle.static_wheel_load,
            labels("N", "static wheel-rail force of a wheel", COMPRESSION),
        ),
    }
