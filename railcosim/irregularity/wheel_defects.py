"""Shapes of a tread over the angle around the wheel: polygons and dents."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, cast

import numpy as np

from vehicle_fmu.parameters import FlatParameters
from vehicle_fmu.wheel_profile import check_flat, flat_profile

from .spectra import REFERENCE, FloatArray

if TYPE_CHECKING:
    from vehicle_fmu.parameters import FlatShape


def polygon(angle: FloatArray, *, order: int, amplitude: float, phase: float = 0.0) -> FloatArray:
    """Return one order of a polygonal wheel, amplitude cos(order angle + phase) [m]."""
    return amplitude * np.cos(order * angle + phase)


def amplitude_of(level_db: float) -> float:
    """Return the amplitude [m] of a sine whose r.m.s. has this level re 1 um [dB]."""
    return math.sqrt(2.0) * REFERENCE * math.pow(10.0, level_db / 20.0)


def dent(
    angle: FloatArray,
    *,
    centre: float,
    length: float,
    depth: float,
    shape: str,
    rolled: bool,
    radius: float,
) -> FloatArray:
    """Return a flat or a spall [m].

    Parameters
    ----------
    angle : ndarray, shape (n,)
        Around the wheel [rad].
    centre : float
        Angle of the middle of the dent [rad].
    length, depth : float
        Along the tread; largest drop [m].
    shape : {"haversine", "parabola", "cusp", "chord"}
        As of a wheel flat, see `vehicle_fmu.wheel_profile`.
    rolled : bool
        The drop is that of the wheel's centre rolling over the dent, which a short deep one
        hardly lets down; else that of the tread.
    radius : float
        Of the wheel [m].

    Raises
    ------
    ValueError
        If the dent does not fit on the wheel.
    """
    flat = FlatParameters(shape=cast("FlatShape", shape), length=length, depth=depth, rolled=rolled)
    check_flat(flat, None, radius=radius, wheels=1)
    drop = flat_profile(flat, None, radius=radius)
    turned = np.mod(angle - centre + math.pi, 2.0 * math.pi) - math.pi
    struck = np.abs(turned) * radius < 0.5 * length
    dents = np.zeros_like(angle)
    dents[struck] = [drop(s) for s in (turned[struck] * radius).tolist()]
    return dents
