"""Bending moments between nodes, from end moments of the elements and the wheels on them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WheelLoads:
    """Wheels on their elements at some times.

    Attributes
    ----------
    elements : ndarray, shape (wheels,)
        From 0.
    places : ndarray, shape (wheels, times)
        Within the element, from 0 to 1.
    couples : ndarray, shape (2, wheels, times)
        What a unit force puts on the rotation of the element's first and last node [m].
    forces : ndarray, shape (wheels, times)
        Contact forces [N].
    """

    elements: NDArray[np.intp]
    places: NDArray[np.float64]
    couples: NDArray[np.float64]
    forces: NDArray[np.float64]


def moments_between(
    ends: NDArray[np.float64],
    loads: WheelLoads,
    *,
    elements: NDArray[np.intp],
    places: NDArray[np.float64],
    length: float,
    last: int,
) -> NDArray[np.float64]:
    """Return bending moments [N m], sagging positive.

    In an element the moment is a straight line, but for a wheel on it, which adds the triangle of
    a simply supported beam; the end moment of a loaded element lacks the fixed-end moment.

    Parameters
    ----------
    ends : ndarray, shape (2, points, times)
        End moments of the elements behind the two nodes of each point's element.
    loads : WheelLoads
        The wheels.
    elements : ndarray, shape (points,)
        Where the moments are wanted,
    places : ndarray, shape (points, times)
        and where in the element, from 0 to 1.
    length : float
        Of an element [m].
    last : int
        Number of the last element, whose last node has no element behind it.
    """
    ends, inside = ends.copy(), np.zeros_like(places)
    for wheel, element in enumerate(loads.elements.tolist()):
        force, there = loads.forces[wheel], loads.places[wheel]
        for side in (0, 1):
            behind = elements + side == element
            ends[side, behind] -= loads.couples[0, wheel] * force
        on_it = elements == element
        if element == last:
            ends[1, on_it] += loads.couples[1, wheel] * force
        near = np.minimum(places[on_it], there)
        inside[on_it] += force * length * near * (1.0 - np.maximum(places[on_it], there))
    return np.asarray((1.0 - places) * ends[0] + places * ends[1] + inside)
