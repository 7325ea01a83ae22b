"""The path of a wheel's centre as it rolls over a defect of its tread."""

import math
from collections.abc import Callable

import numpy as np

from .interpolation import PiecewiseCubic, linear_curve

# Along the rail and along the tread. With h the distance of these points, straight lines between
# them are off by h^2 / (8 R) and the lowest of them by h^2 (r'' + 1 / R) / 8: 1 nm each for a
# flat of 100 mm.
_INTERVALS = 2000


def rolled(
    drop: Callable[[float], float], *, first: float, last: float, radius: float
) -> PiecewiseCubic:
    """Return the drop of the wheel's centre, e(x) = min over s of [r(s) + (s - x)^2 / (2 R)].

    At the distance x past the flat's centre the wheel rests on whichever point s of its tread is
    lowest then, not necessarily on the point straight below its axle.

    Parameters
    ----------
    drop : callable
        Drop r(s) of the tread [m] over the distance s along it [m]; zero outside
        `first` < s < `last`.
    first, last : float
        Extent of the defect [m].
    radius : float
        Wheel radius R [m].

    Returns
    -------
    PiecewiseCubic
        e(x) [m], zero outside its ends. These are `first` and `last`, further out if the tread
        is raised somewhere (r < 0), since raised metal touches the rail early.
    """
    tread = np.linspace(first, last, _INTERVALS + 1)
    tread_drop = np.array([drop(s) for s in tread.tolist()])
    early = reach(float(tread_drop.min()), radius=radius)
    positions = np.linspace(first - early, last + early, _INTERVALS + 1)
    path = [
        min(drop(x), float((tread_drop + (tread - x) ** 2 / (2.0 * radius)).min()))
        for x in positions.tolist()
    ]
    return linear_curve(positions, np.array(path))


def reach(least_drop: float, *, radius: float) -> float:
    """Return how far ahead a point of this drop touches the rail [m]; zero unless it is raised."""
    return math.sqrt(2.0 * radius * max(0.0, -least_drop))
