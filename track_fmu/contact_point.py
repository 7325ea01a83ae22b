"""Where a wheel stands on the rail and how it loads and feels the coordinates there."""

from __future__ import annotations

import math
from dataclasses import dataclass

from .beam_element import FloatArray, deflection_shape, deflection_slope, shear_parameter
from .parameters import TrackParameters


@dataclass(frozen=True, slots=True)
class RailPoint:
    """A point of the rail.

    Attributes
    ----------
    element : int
        The element that holds it; a point on a node belongs to the element behind it.
    xi : float
        Position within the element, 0..1.
    shape, slope : (4,) float array
        Interpolation of the deflection and of its derivative by x [1/m ...].
    """

    element: int
    xi: float
    shape: FloatArray
    slope: FloatArray

    @property
    def rows(self) -> slice:
        """Coordinates of the element's two nodes."""
        return slice(2 * self.element, 2 * self.element + 4)


def locate(
    parameters: TrackParameters, position: float, *, window: float | None = None
) -> RailPoint:
    """Find the point of the rail at a track position.

    Parameters
    ----------
    parameters : TrackParameters
        The track.
    position : float
        Along the rail [m].
    window : float or None
        Where the window of an endless track begins [m]; None for a track that begins at 0 m.

    Raises
    ------
    ValueError
        If the position is not a number or not on the track.
    """
    inside = position if window is None else position - window
    if not (math.isfinite(inside) and 0.0 <= inside <= parameters.length):
        if window is not None:
            raise ValueError(
                f"track: position {position!r} m lies outside the window of {window:g} to "
                f"{window + parameters.length:g} m that moves with the wheels; use shorter steps "
                "or more bays"
            )
        raise ValueError(
            f"track: position {position!r} m lies outside the track of 0 to "
            f"{parameters.length:g} m; start later, stop earlier or use more bays"
        )
    length = parameters.element_length
    scaled = inside / length
    element = min(int(scaled), parameters.elements - 1)
    xi = scaled - element
    phi = shear_parameter(parameters.section, length)
    return RailPoint(
        element, xi, deflection_shape(xi, length, phi), deflection_slope(xi, length, phi)
    )
