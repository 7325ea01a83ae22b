"""Half a sleeper as the track sees it: its own matrices, its bed and its rail seat.

The track and its loads are symmetric about the centreline between the rails, so half a sleeper
will do: its centre does not rotate and carries no shear force, its end is free. A beam lies on
ballast that is spread evenly along it, and the matrices of the bed are those of a total stiffness
of one, so that a beam that does not bend stands on the spring and damper of Table 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import scipy.linalg as la

from .beam_element import (
    BeamSection,
    FloatArray,
    deflection_shape,
    mass_matrix,
    shear_parameter,
    stiffness_matrix,
)

if TYPE_CHECKING:
    from .parameters import TrackParameters


@dataclass(frozen=True, slots=True, kw_only=True)
class HalfSleeper:
    """Half a sleeper of ``s`` degrees of freedom ``u``.

    A rigid sleeper has its displacement alone; a beam has the deflection of its centre and then
    deflection and rotation of every further node out to its end.

    Bending moments (sagging positive) come from the end couple of an element,
    ``moment_stiffness u + moment_mass u'' + moment_bed (k u + c u') - moment_spread f``, with the
    bed's total stiffness ``k`` and damping ``c`` and an evenly spread force ``f``.

    Attributes
    ----------
    mass, stiffness : (s, s) float array
        Without the bed [kg ...], [N/m ...].
    bed : (s, s) float array
        Of an even bed with a total stiffness of one [-].
    mean : (s,) float array
        Gives the mean deflection [-]; also how an evenly spread unit force loads ``u``.
    seat : int
        Place of the rail seat's deflection in ``u``.
    moment_stiffness, moment_mass, moment_bed : (m, s) float array
        At the rail seat and at the centre; ``m`` is 2, and 0 for a rigid sleeper.
    moment_spread : (m,) float array
        Likewise [m].
    """

    mass: FloatArray
    stiffness: FloatArray
    bed: FloatArray
    mean: FloatArray
    seat: int
    moment_stiffness: FloatArray
    moment_mass: FloatArray
    moment_bed: FloatArray
    moment_spread: FloatArray

    @property
    def size(self) -> int:
        """Number of degrees of freedom s."""
        return len(self.mean)

    def bed_forces(self, count: int) -> FloatArray:
        """Forces of the bed under the lowest shapes of the free sleeper, (s, at most count).

        The largest in every column is one.
        """
        last = min(count, self.size) - 1
        _, shapes = la.eigh(self.stiffness, self.mass, subset_by_index=[0, last])
        forces = np.asarray(self.bed @ shapes)
        largest = forces[np.argmax(np.abs(forces), axis=0), np.arange(last + 1)]
        return np.asarray(forces / largest)


def half_sleeper(parameters: TrackParameters) -> HalfSleeper:
    """Half of one of the sleepers of a track."""
    if parameters.sleeper == "rigid":
        one, none = np.ones((1, 1)), np.zeros((0, 1))
        return HalfSleeper(
            mass=parameters.sleeper_mass * one,
            stiffness=0.0 * one,
            bed=one,
            mean=np.ones(1),
            seat=0,
            moment_stiffness=none,
            moment_mass=none,
            moment_bed=none,
            moment_spread=np.zeros(0),
        )
    nodes, seat = sleeper_nodes(
        parameters.sleeper_half_length, parameters.sleeper_rail_seat, parameters.sleeper_elements
    )
    return _beam(parameters.sleeper_section, nodes, seat)


def sleeper_nodes(half_length: float, rail_seat: float, elements: int) -> tuple[FloatArray, int]:
    """Nodes from the centre to the end [m], shape (elements + 1,), and which is the rail seat.

    The elements on either side of the rail seat are equal; they are shared out so that the longest
    is as short as can be.
    """
    inner = min(
        range(1, elements),
        key=lambda n: max(rail_seat / n, (half_length - rail_seat) / (elements - n)),
    )
    inside = np.linspace(0.0, rail_seat, inner + 1)
    outside = np.linspace(rail_seat, half_length, elements - inner + 1)
    return np.concatenate((inside, outside[1:])), inner


def _beam(section: BeamSection, nodes: FloatArray, seat: int) -> HalfSleeper:
    """Assemble a beam; the rotation of its first node is held."""
    size, half_length = 2 * len(nodes), float(nodes[-1])
    mass, stiffness, bed = (np.zeros((size, size)) for _ in range(3))
    mean = np.zeros(size)
    rows, spread = {}, {}
    for element, length in enumerate(np.diff(nodes).tolist()):
        part = slice(2 * element, 2 * element + 4)
        own = _element(section, length, half_length)
        for whole, matrix in zip((stiffness, mass, bed), own[:3], strict=True):
            whole[part, part] += matrix
        mean[part] += own[3]
        if element in (seat, 0):
            # theta = w' has its moment -EI theta': the couple at the inner end is the sagging one
            rows[element] = np.zeros((3, size))
            rows[element][:, part] = [matrix[1] for matrix in own[:3]]
            spread[element] = own[3][1]
    free = np.delete(np.arange(size), 1)
    moments = np.array([rows[seat], rows[0]])[:, :, free]
    return HalfSleeper(
        mass=mass[np.ix_(free, free)],
        stiffness=stiffness[np.ix_(free, free)],
        bed=bed[np.ix_(free, free)],
        mean=mean[free],
        seat=2 * seat - 1,
        moment_stiffness=moments[:, 0],
        moment_mass=moments[:, 1],
        moment_bed=moments[:, 2],
        moment_spread=np.array([spread[seat], spread[0]]),
    )


def _element(
    section: BeamSection, length: float, half_length: float
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Stiffness, mass and bed of an element, and its share of the mean deflection."""
    phi = shear_parameter(section, length)
    points, weights = np.polynomial.legendre.leggauss(4)
    bed, mean = np.zeros((4, 4)), np.zeros(4)
    for point, weight in zip(points, weights, strict=True):
        shape = deflection_shape(0.5 * (1.0 + float(point)), length, phi)
        share = 0.5 * float(weight) * length / half_length
        bed += share * np.outer(shape, shape)
        mean += share * shape
    return stiffness_matrix(section, length), mass_matrix(section, length), bed, mean
