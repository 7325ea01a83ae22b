"""How hard the wheels press on the rail, and how long they do not."""

from __future__ import annotations

from typing import TYPE_CHECKING

import xarray as xr

from ..contact_loss import contact_losses
from ..signals import labels
from .extremes import largest, smallest

if TYPE_CHECKING:
    from collections.abc import Callable


def wheel_loads(passage: xr.Dataset) -> xr.Dataset:
    """Find the largest and smallest contact force of every wheel, and its losses of contact.

    Parameters
    ----------
    passage : xarray.Dataset
        Result of a passage.

    Returns
    -------
    xarray.Dataset
        Over the whole run, dim wheel: ``max_contact_force`` and ``min_contact_force`` [N],
        ``dynamic_factor`` (largest over static), ``contact_losses`` (how many),
        ``loss_of_contact_time`` (their sum) and ``longest_loss_of_contact`` [s].
    """
    force = passage["contact_force"]
    factor = largest(force) / passage["static_wheel_load"]

    def over_losses(number: Callable[[list[float]], float], *meaning: str) -> xr.DataArray:
        values = [number(durations) for durations in _losses(passage)]
        return xr.DataArray(values, dims="wheel", attrs=labels(*meaning))

    return xr.Dataset(
        {
            "max_contact_force": largest(force),
            "min_contact_force": smallest(force),
            "dynamic_factor": factor.assign_attrs(
                labels("1", "largest contact force over the static wheel load")
            ),
            "contact_losses": over_losses(len, "1", "number of losses of contact"),
            "loss_of_contact_time": over_losses(
                lambda durations: sum(durations, 0.0), "s", "time without contact"
            ),
            "longest_loss_of_contact": over_losses(
                lambda durations: max(durations, default=0.0), "s", "longest loss of contact"
            ),
        },
        coords={"wheel": passage["wheel"]},
    )


def _losses(passage: xr.Dataset) -> list[list[float]]:
    """Return how long every loss of contact of every wheel lasts [s]."""
    time = passage["time"].to_numpy()
    gaps = passage["gap"].transpose("wheel", "time").to_numpy()
    return [[end - start for start, end in contact_losses(time, gap)] for gap in gaps]
