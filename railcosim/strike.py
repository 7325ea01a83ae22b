"""The numbers of the flat's strike: what most of a summary looks at."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .contact_loss import contact_losses
from .signals import COMPRESSION, DOWN, FORWARDS, SAGGING

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

WINDOW = (-0.1, 0.8)
"""Part of the run that most numbers look at: the flat's wheel from the flat's centre [m]."""

SIGNALS_OF_A_STRIKE = ("contact_force", "gap", "bending_moment", "bending_moment_under_wheel")
"""Series that the numbers come from."""

_FLAT_WHEEL = "of the flat's wheel, 0.1 m before to 0.8 m after the flat's centre"

PASSAGE_NUMBERS: dict[str, tuple[str, str, str]] = {
    "peak_contact_force": ("N", f"largest contact force {_FLAT_WHEEL}", COMPRESSION),
    "peak_contact_force_position": (
        "m",
        "distance from the flat's centre at the largest contact force",
        FORWARDS,
    ),
    "min_contact_force": ("N", f"smallest contact force {_FLAT_WHEEL}", COMPRESSION),
    "loss_of_contact_time": ("s", f"time without contact {_FLAT_WHEEL}", "none"),
    "max_sleeper_displacement": ("m", "largest displacement of any sleeper", DOWN),
    "peak_bending_moment_midspan": (
        "N m",
        "largest bending moment of the rail in the middle of the struck bay",
        SAGGING,
    ),
    "peak_bending_moment_under_wheel": (
        "N m",
        "largest bending moment of the rail under the flat's wheel",
        SAGGING,
    ),
}
"""Units, long name and sign of the numbers of `strike_numbers`, and of the deepest sleeper."""


def strike_numbers(passage: xr.Dataset) -> dict[str, float]:
    """Compute the numbers of the flat's strike from whole histories.

    Parameters
    ----------
    passage : xarray.Dataset
        Series `SIGNALS_OF_A_STRIKE` over ``time`` with its coordinate ``distance``, and
        ``flat_wheel``.

    Returns
    -------
    dict of str to float
        By name; none where the run has not reached `WINDOW`.
    """
    points = _window_points(passage["distance"].to_numpy())
    if points.size == 0:
        return {}
    wheel = passage.sel(wheel=passage["flat_wheel"])

    def cut(variable: xr.DataArray) -> NDArray[np.float64]:
        return np.interp(points, passage["distance"], variable)

    force = cut(wheel["contact_force"])
    losses = contact_losses(cut(passage["time"]), cut(wheel["gap"]))
    return {
        "peak_contact_force": float(force.max()),
        "peak_contact_force_position": float(points[force.argmax()]),
        "min_contact_force": float(force.min()),
        "loss_of_contact_time": sum((end - start for start, end in losses), 0.0),
        "peak_bending_moment_midspan": float(cut(passage["bending_moment"].isel(gauge=0)).max()),
        "peak_bending_moment_under_wheel": float(cut(wheel["bending_moment_under_wheel"]).max()),
    }


def _window_points(distance: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the distances inside `WINDOW` and its ends, none where the run has not reached it."""
    if distance.size == 0:
        return distance
    start, end = max(WINDOW[0], distance[0]), min(WINDOW[1], distance[-1])
    if end < start:
        return np.empty(0)
    inside = distance[(distance > start) & (distance < end)]
    return np.unique(np.concatenate(([start], inside, [end])))
