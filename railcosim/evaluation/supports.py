"""What the supports of the rail carry."""

from __future__ import annotations

import xarray as xr

from .extremes import largest, smallest


def support_loads(passage: xr.Dataset) -> xr.Dataset:
    """Find the largest and smallest forces of every support over the run.

    Parameters
    ----------
    passage : xarray.Dataset
        Result of a passage.

    Returns
    -------
    xarray.Dataset
        ``max_pad_force``, ``min_pad_force``, ``max_ballast_force``, ``min_ballast_force`` [N] and
        ``max_sleeper_displacement`` [m], dim sleeper. Forces below zero pull, as the pads and the
        ballast of the model can.
    """
    pad, ballast = passage["pad_force"], passage["ballast_force"]
    return xr.Dataset(
        {
            "max_pad_force": largest(pad),
            "min_pad_force": smallest(pad),
            "max_ballast_force": largest(ballast),
            "min_ballast_force": smallest(ballast),
            "max_sleeper_displacement": largest(passage["sleeper_displacement"]),
        }
    )
