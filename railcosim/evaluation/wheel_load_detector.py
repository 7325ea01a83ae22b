"""The record of a wheel load detector: contact forces as instrumented bays see them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from ..scenario_file import from_toml
from ..signals import COMPRESSION, FORWARDS, labels
from .resampling import resample
from .settings import Evaluation

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..scenario import Scenario


def wheel_load_record(passage: xr.Dataset, settings: Evaluation | None = None) -> xr.Dataset:
    """Record the contact forces bay by bay, as strain gauges on the web of the rail would.

    Idealised: a bay shows the sum of the contact forces of the wheels in its middle part, as they
    are; a real detector infers them from shear strains, with its own calibration, cross-talk of
    neighbouring bays and the inertia of the rail between its gauges.

    Parameters
    ----------
    passage : xarray.Dataset
        Result of a passage.
    settings : Evaluation, optional
        Its ``rate``, ``bays`` and ``bay_share``; by default nine whole bays sampled at 6 kHz, as
        at the test site of Nielsen & Oscarsson (2004), section 4.

    Returns
    -------
    xarray.Dataset
        ``bay_force`` [N], dims (record_time, bay), low-passed and sampled (see
        `resampling.resample`), zero in an empty bay; and of every wheel in every bay
        ``bay_max_force``, ``bay_mean_force`` [N], ``bay_dynamic_factor`` (their ratio), dims
        (bay, wheel), and ``bay_seen``, the share of the instrumented part that the wheel rolled
        over in the run. Without a sample in it, or a force, the others are NaN: there is no such
        reading.
    """
    settings = settings or Evaluation()
    scenario = from_toml(passage.attrs["scenario"])
    bays = _instrumented(scenario, settings.bays)
    times = passage["time"].to_numpy()
    forces, positions = (
        passage[name].transpose("time", "wheel").to_numpy()
        for name in ("contact_force", "wheel_position")
    )
    samples = resample(times, forces, settings.rate)
    places = np.stack([np.interp(samples.x, times, column) for column in positions.T], axis=1)
    middles = (bays - 0.5) * scenario.track.sleeper_spacing
    reach = 0.5 * settings.bay_share * scenario.track.sleeper_spacing
    offsets = places[:, None, :] - middles[:, None]
    inside = (offsets >= -reach) & (offsets < reach)
    ends = np.clip(positions[[0, -1]][:, None, :], *(middles[:, None] + [[[-reach]], [[reach]]]))
    return xr.Dataset(
        {
            "bay_force": (
                ("record_time", "bay"),
                (inside * samples.values[:, None, :]).sum(axis=2),
                labels("N", "contact force of the wheels in the bay", COMPRESSION),
            ),
            **_readings(inside, samples.values),
            "bay_seen": (
                ("bay", "wheel"),
                (ends[1] - ends[0]) / (2.0 * reach),
                labels("1", "share of the instrumented part that the wheel rolled over"),
            ),
        },
        coords={
            "record_time": ("record_time", samples.x, passage["time"].attrs),
            "bay": ("bay", bays, labels("1", "number of the bay from the start of the track")),
            "bay_position": ("bay", middles, labels("m", "middle of the bay", FORWARDS)),
            "wheel": passage["wheel"],
        },
        attrs={"sampling_rate": settings.rate, "frequency_limit": samples.limit},
    )


def _instrumented(scenario: Scenario, bays: int) -> NDArray[np.int_]:
    """Return the numbers of so many bays around the struck one, as far as there are."""
    first = scenario.struck_bay - (bays - 1) // 2
    numbers = np.arange(first, first + bays)
    if scenario.track.endless:
        return numbers
    return numbers[(numbers >= 1) & (numbers <= scenario.track.bays)]


def _readings(inside: NDArray[np.bool_], forces: NDArray[np.float64]) -> dict[str, object]:
    """Read the largest and the mean force of every wheel in every bay."""
    number = inside.sum(axis=0)
    seen = number > 0
    largest = np.where(inside, forces[:, None, :], -np.inf).max(axis=0)
    total = np.where(inside, forces[:, None, :], 0.0).sum(axis=0)
    largest = np.where(seen, largest, np.nan)
    mean = _quotient(total, number)
    dims = ("bay", "wheel")
    return {
        "bay_max_force": (
            dims,
            largest,
            labels("N", "largest contact force of the wheel in the bay", COMPRESSION),
        ),
        "bay_mean_force": (
            dims,
            mean,
            labels("N", "mean contact force of the wheel in the bay", COMPRESSION),
        ),
        "bay_dynamic_factor": (
            dims,
            _quotient(largest, mean),
            labels("1", "largest over mean contact force of the wheel in the bay"),
        ),
    }


def _quotient(
    above: NDArray[np.float64], below: NDArray[np.float64] | NDArray[np.int_]
) -> NDArray[np.float64]:
    """Divide; NaN where there is nothing to divide by."""
    quotient = np.full(above.shape, np.nan)
    np.divide(above, below, out=quotient, where=np.asarray(below > 0))
    return quotient
