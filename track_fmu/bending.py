"""Bending moment at any point of the rail, from element end forces."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .beam_element import FloatArray
from .contact_point import RailPoint
from .eigensolver import ComplexArray
from .reduction import ReducedTrack


def bending_moment(
    track: ReducedTrack,
    point: RailPoint,
    *,
    modal_state: ComplexArray,
    forces: FloatArray,
    loads: Sequence[tuple[RailPoint, float]],
) -> float:
    """Bending moment of the rail [N m], sagging positive.

    Between the nodes of an element the moment is linear but for the wheels that stand on the
    element itself; each adds the triangle of a simply supported beam.

    Parameters
    ----------
    track : ReducedTrack
        The track.
    point : RailPoint
        Where the moment is wanted.
    modal_state : (S,) complex array
        ``q``, times the modal weight.
    forces : (n,) float array
        Forces on the coordinates, wheels included.
    loads : sequence of (RailPoint, float)
        The wheels and their contact forces [N].
    """
    nodes = slice(point.element, point.element + 2)
    ends = np.real(track.moment_shape[nodes] @ modal_state)
    ends = ends + track.moment_flexibility[nodes] @ forces
    length, last = track.parameters.element_length, track.parameters.elements - 1
    inside = 0.0
    for wheel, force in loads:
        # the end couple of a loaded element lacks the fixed-end moment of its load
        behind = wheel.element - point.element
        if behind in (0, 1):
            ends[behind] -= wheel.shape[1] * force
        if behind == 0:
            if wheel.element == last:
                ends[1] += wheel.shape[3] * force
            near, far = sorted((point.xi, wheel.xi))
            inside += force * length * near * (1.0 - far)
    return float((1.0 - point.xi) * ends[0] + point.xi * ends[1] + inside)
