"""The track seen through the coordinates in which it is loaded and observed.

Coordinates, in this order (n of them):

* deflection and rotation of every rail node, ``2 * nodes`` of them; those of the clamped ends are
  kept as zeros, so that the element from node ``e`` to ``e + 1`` always has rows ``2e .. 2e + 3``;
* deformation of the ballast under every sleeper: its displacement, a weighted mean if it bends;
* deformation of every rail pad, rail minus rail seat.

A force on a coordinate is positive when it does positive work on it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg as la
import scipy.sparse as sp

from .assembly import IntArray, TrackMatrices, to_banded
from .beam_element import FloatArray, mass_matrix, stiffness_matrix
from .eigensolver import ComplexArray
from .modal import ModalBasis
from .parameters import TrackParameters
from .sleeper_observation import sleeper_operators


@dataclass(frozen=True, slots=True, kw_only=True)
class ReducedTrack:
    """Modes and residual flexibility in coordinates.

    Displacements are ``y = Re(shape @ (weight q)) + flexibility @ f`` and bending moments (sagging
    positive) ``m = Re(moment_shape @ (weight q)) + moment_flexibility @ f`` for the forces ``f``
    on the coordinates and the modal states ``q' = lambda q + shape^T f``.

    Attributes
    ----------
    parameters : TrackParameters
        The linear track.
    eigenvalues : (S,) complex array
        ``lambda_n`` [1/s].
    weight : (S,) float array
        2 for a complex pair, 1 for a real state.
    shape : (n, S) complex array
        Modal displacement of the coordinates, ``a_n = 1``.
    moment_shape : (nodes, S) complex array
        Modal bending moment at the nodes.
    flexibility : (n, n) float array
        Residual flexibility of the truncated modes, Eq. (13); zero if left out.
    moment_flexibility : (nodes, n) float array
        Likewise for the bending moments; complete up to the load inside an element, which
        `bending.py` adds.
    sleeper_shape : (m, S) complex array
        Modal rows of what `SleeperOperators` observes of sleepers that bend.
    sleeper_flexibility : (m, n) float array
        Likewise of the truncated modes, with what the spread forces do inside an element.
    bent_shape : (supports * s, S) complex array
        Modal displacements of all degrees of freedom of sleepers that bend, one sleeper after the
        other; no rows for rigid ones, whose displacements are coordinates.
    bent_flexibility : (supports * s, n) float array
        Likewise of the truncated modes.
    """

    parameters: TrackParameters
    eigenvalues: ComplexArray
    weight: FloatArray
    shape: ComplexArray
    moment_shape: ComplexArray
    flexibility: FloatArray
    moment_flexibility: FloatArray
    sleeper_shape: ComplexArray
    sleeper_flexibility: FloatArray
    bent_shape: ComplexArray
    bent_flexibility: FloatArray

    @property
    def seat_rows(self) -> slice:
        """Coordinates of the rail's deflection above every sleeper."""
        per_bay = self.parameters.elements_per_bay
        return slice(2 * per_bay, 2 * self.parameters.elements, 2 * per_bay)

    @property
    def ballast_rows(self) -> slice:
        """Coordinates of the ballast."""
        first = 2 * (self.parameters.elements + 1)
        return slice(first, first + self.parameters.supports)

    @property
    def pad_rows(self) -> slice:
        """Coordinates of the rail pads."""
        first = self.ballast_rows.stop
        return slice(first, first + self.parameters.supports)


def reduce_track(
    parameters: TrackParameters,
    matrices: TrackMatrices,
    basis: ModalBasis,
    *,
    residual_flexibility: bool = True,
) -> ReducedTrack:
    """Express modes and residual flexibility in coordinates.

    Parameters
    ----------
    parameters, matrices, basis
        The same track, assembled and solved.
    residual_flexibility : bool
        False leaves the quasi-static contribution of the truncated modes out, which is only of
        use to see what it is worth.
    """
    coordinates = _coordinate_operator(matrices)
    static_moments, modal_moments = moment_operators(parameters, matrices)
    of_sleepers = sleeper_operators(parameters, matrices)
    shape = np.asarray(coordinates @ basis.modes)
    moment_shape = np.asarray(
        static_moments @ basis.modes + (modal_moments @ basis.modes) * basis.eigenvalues**2
    )
    sleeper_shape = of_sleepers.of_modes(basis)
    sleeper_flexibility = of_sleepers.of_forces(coordinates.shape[0])
    nodes, count = len(matrices.numbering.rail), coordinates.shape[0]
    bent = _bent_dofs(parameters, matrices)
    bent_shape, bent_flexibility = basis.modes[bent], np.zeros((len(bent), count))
    if residual_flexibility:
        response = _static_response(matrices, coordinates)
        modal = shape * (basis.weight / basis.eigenvalues)
        # shape @ modal.T is minus the static response of the retained modes
        flexibility = np.asarray(coordinates @ response) + _real_product(shape, modal)
        moment_flexibility = np.asarray(static_moments @ response)
        moment_flexibility += _real_product(moment_shape, modal)
        sleeper_flexibility += of_sleepers.static @ response
        sleeper_flexibility += _real_product(sleeper_shape, modal)
        bent_flexibility = response[bent] + _real_product(bent_shape, modal)
    else:
        flexibility = np.zeros((count, count))
        moment_flexibility = np.zeros((nodes, count))
    return ReducedTrack(
        parameters=parameters,
        eigenvalues=basis.eigenvalues,
        weight=basis.weight,
        shape=shape,
        moment_shape=moment_shape,
        flexibility=flexibility,
        moment_flexibility=moment_flexibility,
        sleeper_shape=sleeper_shape,
        sleeper_flexibility=sleeper_flexibility,
        bent_shape=bent_shape,
        bent_flexibility=bent_flexibility,
    )


def _bent_dofs(parameters: TrackParameters, matrices: TrackMatrices) -> IntArray:
    """Degrees of freedom of sleepers that bend, one sleeper after the other."""
    dofs = matrices.numbering.sleeper_dofs
    return dofs[:0].ravel() if parameters.sleeper == "rigid" else dofs.ravel()


def _coordinate_operator(matrices: TrackMatrices) -> sp.csr_array:
    """Coordinates from degrees of freedom, shape (n, N); empty rows at the clamped ends."""
    dofs = matrices.numbering.rail.ravel()
    rows = np.flatnonzero(dofs >= 0)
    rail = sp.coo_array(
        (np.ones(len(rows)), (rows, dofs[rows])), shape=(len(dofs), matrices.numbering.size)
    )
    return sp.csr_array(sp.vstack([rail, matrices.ballast_incidence.T, matrices.pad_incidence.T]))


def _static_response(matrices: TrackMatrices, coordinates: sp.csr_array) -> FloatArray:
    """``K^-1`` times unit forces on the coordinates, shape (N, n)."""
    response = la.solveh_banded(
        to_banded(matrices.stiffness), coordinates.T.toarray(), lower=True, overwrite_b=True
    )
    return np.asarray(response)


def _real_product(left: ComplexArray, right: ComplexArray) -> FloatArray:
    """``Re(left @ right.T)`` with two real products."""
    return np.asarray(left.real @ right.real.T - left.imag @ right.imag.T)


def moment_operators(
    parameters: TrackParameters, matrices: TrackMatrices
) -> tuple[sp.csr_array, sp.csr_array]:
    """Operators S and D, shape (nodes, N), of the nodal bending moments ``S x + D x''``.

    The moment is the end moment of the element behind the node (the one before it at the last
    node), from ``K_e x + M_e x''``, so that the inertia of the element is accounted for.
    """
    length, section = parameters.element_length, parameters.section
    elements = stiffness_matrix(section, length), mass_matrix(section, length)
    numbering = matrices.numbering
    nodes = len(numbering.rail)
    dofs = np.hstack([numbering.rail[:-1], numbering.rail[1:]])
    dofs = np.vstack([dofs, dofs[-1]])
    shape = (nodes, numbering.size)
    operators = []
    for element in elements:
        # theta = w' has its moment -EI theta': the end couple at the left end is the sagging
        # moment, that at the right end its negative
        values = np.tile(element[1], (nodes, 1))
        values[-1] = -element[3]
        rows = np.repeat(np.arange(nodes), 4)
        free = dofs.ravel() >= 0
        operators.append(
            sp.csr_array(
                sp.coo_array((values.ravel()[free], (rows[free], dofs.ravel()[free])), shape=shape)
            )
        )
    return operators[0], operators[1]
