"""Half a sleeper as the track sees it: its own matrices, its bed and its rail seat.

The track and its loads are symmetric about the centreline between the rails, so half a sleeper
will do: its centre does not rotate and carries no shear force, its end is free. A beam lies on
ballast that is spread evenly along it, and the matrices of the bed are those of a total stiffness
of one, so that a beam that does not bend stands on the spring and damper of Table 1.

What state-dependent ballast adds is one force per sleeper, as under a rigid one, but spread over
the length like the square of the deflection under a load on the rail seat (the leading term of
Eq. 27 is a square), and driven by the deflection averaged with the same weight. A sleeper that does
not bend has the law of the rigid one, to the last digit of the weights.
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


LOADED_BED = 4.0
"""Stiffness of a loaded bed over that of the unloaded one: Eq. (26) under 45 kN on a rail seat."""


@dataclass(frozen=True, slots=True, kw_only=True)
class HalfSleeper:
    """Half a sleeper of ``s`` degrees of freedom ``u``.

    A rigid sleeper has its displacement alone; a beam has the deflection of its centre and then
    deflection and rotation of every further node out to its end.

    Bending moments (sagging positive) come from the end couple of an element,
    ``moment_stiffness u + moment_mass u'' + moment_bed (k u + c u') - moment_spread f``, with the
    bed's total stiffness ``k`` and damping ``c`` and the spread force ``f``.

    Attributes
    ----------
    mass, stiffness : (s, s) float array
        Without the bed [kg ...], [N/m ...].
    bed : (s, s) float array
        Of an even bed with a total stiffness of one [-].
    mean : (s,) float array
        Gives the mean deflection [-], which times the bed's stiffness is the force on it.
    spread : (s,) float array
        Gives the weighted mean deflection that drives the state-dependent ballast [-]; also how its
        force, one in all, loads ``u``.
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
    spread: FloatArray
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
            spread=np.ones(1),
            seat=0,
            moment_stiffness=none,
            moment_mass=none,
            moment_bed=none,
            moment_spread=np.zeros(0),
        )
    nodes, seat = sleeper_nodes(
        parameters.sleeper_half_length, parameters.sleeper_rail_seat, parameters.sleeper_elements
    )
    bed = LOADED_BED * parameters.ballast_stiffness
    return _beam(parameters.sleeper_section, nodes, seat, bed)


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


def _beam(section: BeamSection, nodes: FloatArray, seat: int, loaded_bed: float) -> HalfSleeper:
    """Assemble a beam; the rotation of its first node is held."""
    size = 2 * len(nodes)
    free = np.delete(np.arange(size), 1)
    elements = [_element(section, length, nodes[-1]) for length in np.diff(nodes).tolist()]
    stiffness, mass, bed = (
        _assemble([getattr(element, name) for element in elements])[np.ix_(free, free)]
        for name in ("stiffness", "mass", "bed")
    )
    load = np.zeros(len(free))
    load[2 * seat - 1] = 1.0
    deflected = np.zeros(size)
    deflected[free] = la.solve(stiffness + loaded_bed * bed, load, assume_a="pos")
    ends = [slice(2 * n, 2 * n + 4) for n in range(len(elements))]
    squares = [e.squared(deflected[end]) for e, end in zip(elements, ends, strict=True)]
    mean, spread = np.zeros(size), np.zeros(size)
    for element, end, square in zip(elements, ends, squares, strict=True):
        mean[end] += element.mean
        spread[end] += square
    # the deflections of an element sum to one: so do the weights of all of them
    total = sum(float(square[0] + square[2]) for square in squares)
    # theta = w' has its moment -EI theta': the couple at the inner end is the sagging moment
    chosen = [(elements[n], ends[n], squares[n]) for n in (seat, 0)]
    rows = np.zeros((3, 2, size))
    for place, (element, end, _) in enumerate(chosen):
        rows[:, place, end] = element.stiffness[1], element.mass[1], element.bed[1]
    return HalfSleeper(
        mass=mass,
        stiffness=stiffness,
        bed=bed,
        mean=mean[free],
        spread=spread[free] / total,
        seat=2 * seat - 1,
        moment_stiffness=rows[0][:, free],
        moment_mass=rows[1][:, free],
        moment_bed=rows[2][:, free],
        moment_spread=np.array([square[1] / total for _, _, square in chosen]),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Element:
    """Matrices of an element, shape (4, 4), its share of the mean and what that is summed from."""

    stiffness: FloatArray
    mass: FloatArray
    bed: FloatArray
    mean: FloatArray
    shapes: FloatArray
    shares: FloatArray

    def squared(self, ends: FloatArray) -> FloatArray:
        """Share of a mean weighted by the square of a deflection, shape (4,)."""
        weights: FloatArray = self.shares * (self.shapes @ ends) ** 2
        return weights @ self.shapes


def _element(section: BeamSection, length: float, half_length: float) -> _Element:
    phi = shear_parameter(section, length)
    points, weights = np.polynomial.legendre.leggauss(5)  # exact to the ninth degree
    shapes = np.array([deflection_shape(0.5 * (1.0 + float(p)), length, phi) for p in points])
    shares = 0.5 * length / half_length * weights
    return _Element(
        stiffness=stiffness_matrix(section, length),
        mass=mass_matrix(section, length),
        bed=shapes.T @ (shares[:, None] * shapes),
        mean=shares @ shapes,
        shapes=shapes,
        shares=shares,
    )


def _assemble(matrices: list[FloatArray]) -> FloatArray:
    """Sum of element matrices along a beam."""
    whole = np.zeros((2 * len(matrices) + 2, 2 * len(matrices) + 2))
    for n, matrix in enumerate(matrices):
        whole[2 * n : 2 * n + 4, 2 * n : 2 * n + 4] += matrix
    return whole
