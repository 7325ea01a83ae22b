"""Labelled arrays of what rail and wheels are uneven by."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from ..signals import DOWN, FORWARDS

if TYPE_CHECKING:
    from .tables import UnevenSurfaces


def surface_dataset(surfaces: UnevenSurfaces) -> xr.Dataset:
    """Label the tables that the FMUs read.

    Returns
    -------
    xarray.Dataset
        ``rail_drop`` over ``rail_position`` and ``tread_drop`` over ``wheel`` and ``tread_angle``,
        each where there is such a table.
    """
    rail, treads = surfaces.rail, surfaces.treads
    result = xr.Dataset()
    if rail is not None:
        result = result.assign_coords(
            rail_position=(
                "rail_position",
                rail.position,
                _meaning("m", "position along the rail", FORWARDS),
            )
        )
        result["rail_drop"] = (
            "rail_position",
            rail.drop,
            _meaning("m", "drop of the unloaded railhead", DOWN),
        )
    angle = next((tread.angle for tread in treads if tread is not None), None)
    if angle is not None:
        round_tread = np.zeros_like(angle)
        drops = [round_tread if tread is None else tread.drop for tread in treads]
        result = result.assign_coords(
            tread_angle=("tread_angle", angle, _meaning("rad", "angle around the wheel")),
        )
        result["tread_drop"] = (
            ("wheel", "tread_angle"),
            np.stack(drops),
            _meaning("m", "drop of the tread", "positive where metal is missing"),
        )
    return result


def _meaning(units: str, long_name: str, sign: str = "none") -> dict[str, str]:
    return {"units": units, "long_name": long_name, "sign": sign}
