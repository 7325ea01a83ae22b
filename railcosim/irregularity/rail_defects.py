"""Shapes of a railhead: corrugation and dips at joints."""

from __future__ import annotations

import numpy as np

from .spectra import FloatArray


def corrugation(
    position: FloatArray, *, wavelength: float, depth: float, phase: float = 0.0
) -> FloatArray:
    """Return a sine from crest to trough of the given depth [m].

    Parameters
    ----------
    position : ndarray
        Along the rail [m].
    wavelength, depth : float
        Length of a wave; difference of crest and trough [m].
    phase : float
        Phase of the sine at position zero [rad].
    """
    return 0.5 * depth * np.sin(2.0 * np.pi * position / wavelength + phase)


def dip(
    position: FloatArray, *, centre: float, length: float, depth: float, shape: str
) -> FloatArray:
    """Return a dip of a rail [m].

    Over a = |x - centre| / (length / 2) <= 1 its shapes are ``cusp``, depth (1 - a)^2, two rail
    ends bent down to a dipped joint, and ``haversine``, depth / 2 (1 + cos(pi a)), a soft dip.

    Parameters
    ----------
    position : ndarray
        Along the rail [m].
    centre, length, depth : float
        Middle of the dip, its whole length, its largest drop [m].
    shape : {"cusp", "haversine"}
        See above.
    """
    a = np.minimum(np.abs(position - centre) / (0.5 * length), 1.0)
    relative = (1.0 - a) ** 2 if shape == "cusp" else 0.5 * (1.0 + np.cos(np.pi * a))
    return depth * relative


def joint_depth(angle: float, length: float) -> float:
    """Return the depth [m] of a dipped joint of the shape ``cusp`` from its angle.

    Both rail ends arrive with the slope 4 depth / length; their sum is the angle.

    Parameters
    ----------
    angle : float
        Between the tangents of both rail ends at the joint [rad].
    length : float
        Whole length of the dip [m].
    """
    return angle * length / 8.0
