"""What bending moment gauges and strain gauges on the rail show."""

from __future__ import annotations

import xarray as xr

from ..scenario_file import from_toml
from ..signals import labels
from .extremes import largest, smallest
from .settings import Evaluation


def gauge_histories(passage: xr.Dataset, settings: Evaluation | None = None) -> xr.Dataset:
    """Work out the strain at every gauge from the bending moment of the rail.

    The strain of a beam, ``M z / EI``, at the distance z below the neutral axis.

    Parameters
    ----------
    passage : xarray.Dataset
        Result of a passage; its scenario gives EI.
    settings : Evaluation, optional
        Its ``gauge_depth``.

    Returns
    -------
    xarray.Dataset
        ``bending_moment`` [N m] and ``strain`` [1], dims (time, gauge), and over the run
        ``max_bending_moment``, ``min_bending_moment``, ``max_strain`` and ``min_strain``.
    """
    settings = settings or Evaluation()
    stiffness = from_toml(passage.attrs["scenario"]).track.bending_stiffness
    moment = passage["bending_moment"]
    strain = (settings.gauge_depth / stiffness * moment).assign_attrs(
        labels("1", "longitudinal strain of the rail at the gauge", "positive in tension")
    )
    return xr.Dataset(
        {
            "bending_moment": moment,
            "strain": strain,
            "max_bending_moment": largest(moment),
            "min_bending_moment": smallest(moment),
            "max_strain": largest(strain),
            "min_strain": smallest(strain),
        },
        attrs={"gauge_depth": settings.gauge_depth},
    )
