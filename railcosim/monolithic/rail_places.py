"""On which elements of the rail the wheels are, and how much of the nodes' motion is under them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from track_fmu.beam_element import deflection_shape, deflection_slope, shear_parameter

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from track_fmu.parameters import TrackParameters

    from .course import Course


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RailPlaces:
    """The wheels on the rail that is held, while none leaves its element.

    Attributes
    ----------
    course : Course
        Of w wheels.
    parameters : TrackParameters
        Of the track that is held.
    begin : float
        Where that begins, a node of the rail [m].
    elements : ndarray, shape (wheels,)
        On which the wheels are, from 0.
    """

    course: Course
    parameters: TrackParameters
    begin: float
    elements: NDArray[np.intp]

    def moved_to(self, time: float) -> RailPlaces:
        """Return the wheels on the elements where they are at a time [s]."""
        elements = np.floor(self._in_elements(time)).astype(np.intp)
        return replace(self, elements=np.clip(elements, 0, self.parameters.elements - 1))

    def within(self, time: float) -> NDArray[np.float64]:
        """Return where each wheel is within its element, from 0 to 1, shape (wheels,)."""
        return self._in_elements(time) - self.elements

    def shapes(self, time: float) -> NDArray[np.float64]:
        """Return the shape functions of the deflection under each wheel, shape (wheels, 4)."""
        length = self.parameters.element_length
        phi = shear_parameter(self.parameters.section, length)
        return np.array([deflection_shape(xi, length, phi) for xi in self.within(time).tolist()])

    def slopes(self, time: float) -> NDArray[np.float64]:
        """Return those of the slope of the deflection [1/m], shape (wheels, 4)."""
        length = self.parameters.element_length
        phi = shear_parameter(self.parameters.section, length)
        return np.array([deflection_slope(xi, length, phi) for xi in self.within(time).tolist()])

    def _in_elements(self, time: float) -> NDArray[np.float64]:
        """Distances of the wheels from the first node, in elements."""
        return (self.course.positions(time) - self.begin) / self.parameters.element_length
