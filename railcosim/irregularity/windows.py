"""How an irregularity sets in and ends without exciting anything by itself."""

from __future__ import annotations

import numpy as np

from .spectra import FloatArray


def onset(distance: FloatArray, length: float) -> FloatArray:
    """Return a step from 0 to 1 over a length, with two continuous derivatives.

    6 a^5 - 15 a^4 + 10 a^3 over a = distance / length from 0 to 1.

    Parameters
    ----------
    distance : ndarray
        From the start of the step [m].
    length : float
        Of the step [m]; zero for a sudden one.
    """
    if length <= 0.0:
        return np.asarray(np.where(distance >= 0.0, 1.0, 0.0))
    a = np.clip(distance / length, 0.0, 1.0)
    return np.asarray(a**3 * (10.0 + a * (6.0 * a - 15.0)))


def stretch(
    position: FloatArray, *, begin: float | None, end: float | None, taper: float
) -> FloatArray:
    """Return 1 between two positions and 0 outside, smoothly over a length inside both ends.

    Parameters
    ----------
    position : ndarray
        Along the rail [m].
    begin, end : float or None
        Ends of the stretch [m]; None for one that goes on.
    taper : float
        Length of the transitions [m].
    """
    window = np.ones_like(position)
    if begin is not None:
        window *= onset(position - begin, taper)
    if end is not None:
        window *= onset(end - position, taper)
    return window
