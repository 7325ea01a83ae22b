"""Where the track is loaded and where its response is taken: on the rail or at a rail seat."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from track_fmu.assembly import number_dofs
from track_fmu.contact_point import locate

from ..errors import InputError

if TYPE_CHECKING:
    from track_fmu.assembly import IntArray
    from track_fmu.beam_element import FloatArray
    from track_fmu.parameters import TrackParameters

SLEEPER = "sleeper:"
"""How a place on a sleeper is written, before its number."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Place:
    """A place on the rail or a sleeper; one of the two is given.

    Attributes
    ----------
    position : float, optional
        Position along the rail from its clamped start [m].
    sleeper : int, optional
        Number of the sleeper, from 1.
    """

    position: float | None = None
    sleeper: int | None = None

    def __post_init__(self) -> None:
        if (self.position is None) == (self.sleeper is None):
            raise ValueError("a place is either a position on the rail or a sleeper")

    def __str__(self) -> str:
        if self.sleeper is not None:
            return f"sleeper {self.sleeper}"
        return f"rail at {self.position:g} m"

    def along(self, parameters: TrackParameters) -> float:
        """Position along the rail [m], of a sleeper too."""
        if self.position is not None:
            return self.position
        assert self.sleeper is not None
        return self.sleeper * parameters.sleeper_spacing


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TrackPoint:
    """A place as a linear form of the track's displacements.

    Attributes
    ----------
    rows, shape : (k,) int array, (k,) float array
        Coordinates of the reduced track that it depends on, and their weights; also how a unit
        force there loads them.
    dofs, weights : (d,) int array, (d,) float array
        The same in degrees of freedom of the finite elements, -1 where the rail is clamped.
    """

    rows: IntArray
    shape: FloatArray
    dofs: IntArray
    weights: FloatArray


def parse_place(text: str, option: str) -> Place:
    """Read ``16.25`` (metres along the rail) or ``sleeper:25``.

    Raises
    ------
    InputError
        For any other text.
    """
    is_sleeper = text.startswith(SLEEPER)
    try:
        if is_sleeper:
            return Place(sleeper=int(text.removeprefix(SLEEPER)))
        position = float(text)
    except ValueError:
        position = math.nan
    if not math.isfinite(position):
        raise InputError(
            f"{option} {text} is no place: write metres along the rail, as in 16.25, or a "
            f"sleeper, as in {SLEEPER}25"
        )
    return Place(position=position)


def track_point(parameters: TrackParameters, place: Place) -> TrackPoint:
    """Find a place in the numbering of the track.

    Raises
    ------
    InputError
        If it is not on the track.
    """
    numbering = number_dofs(parameters)
    if place.sleeper is not None:
        if not 1 <= place.sleeper <= parameters.supports:
            raise InputError(
                f"there is no sleeper {place.sleeper}: the track has sleepers 1 to "
                f"{parameters.supports}, choose one of them or raise track.bays"
            )
        number = place.sleeper - 1
        # a rail seat moves as the rail above it less the deformation of the pad between them
        rail = 2 * int(numbering.support_node[number])
        pad = 2 * (parameters.elements + 1) + parameters.supports + number
        return TrackPoint(
            rows=np.array([rail, pad]),
            shape=np.array([1.0, -1.0]),
            dofs=numbering.sleeper[number : number + 1],
            weights=np.ones(1),
        )
    assert place.position is not None
    if not 0.0 < place.position < parameters.length:
        raise InputError(
            f"the place {place.position:g} m is not between the clamped ends of the rail at 0 m "
            f"and {parameters.length:g} m: move it or raise track.bays"
        )
    point = locate(parameters, place.position)
    return TrackPoint(
        rows=np.arange(point.rows.start, point.rows.stop),
        shape=point.shape,
        dofs=numbering.rail[point.element : point.element + 2].ravel(),
        weights=point.shape,
    )
