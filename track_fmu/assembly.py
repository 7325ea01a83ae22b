"""Assembly of the linear finite element model of the track.

The degrees of freedom are numbered along the rail (deflection and rotation of a node, then the
sleeper below it if there is one), which keeps the half-bandwidth at 4 for rigid sleepers and at
``2 * sleeper_elements + 4`` for those that bend, however long the track is.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from .beam_element import FloatArray, mass_matrix, stiffness_matrix
from .parameters import TrackParameters
from .sleeper import HalfSleeper, half_sleeper

IntArray = NDArray[np.intp]

DAMPED_SHAPES = 3  # of a sleeper; forces of its bed beyond them leave the low modes as they are


@dataclass(frozen=True, slots=True, kw_only=True)
class Numbering:
    """Numbers of the degrees of freedom; -1 where the rail is clamped.

    Attributes
    ----------
    rail : (nodes, 2) int array
        Deflection and rotation of every rail node.
    sleeper : (supports,) int array
        Displacement of every sleeper, at its rail seat.
    sleeper_dofs : (supports, s) int array
        All degrees of freedom of every sleeper, in the order of `HalfSleeper`.
    support_node : (supports,) int array
        Rail node above every sleeper.
    size : int
        Number of degrees of freedom.
    """

    rail: IntArray
    sleeper: IntArray
    sleeper_dofs: IntArray
    support_node: IntArray
    size: int


@dataclass(frozen=True, slots=True, kw_only=True)
class TrackMatrices:
    """Linear track ``M x'' + C x' + K x = f`` and the parts it is made of.

    ``K = rail_stiffness + D_p k_p D_p^T + k_b B + K_s`` with the incidence matrix of pads (rail
    minus rail seat), the matrix ``B`` of the beds and the sleepers' own stiffness; ``C`` likewise;
    ``M = rail_mass + M_s``. Rigid sleepers have ``B = D_b D_b^T`` and no stiffness of their own.

    Attributes
    ----------
    numbering : Numbering
        Where each physical displacement is found.
    rail_stiffness, rail_mass : (N, N) sparse array
        The rail alone [N/m ...], [kg ...].
    pad_incidence, ballast_incidence : (N, supports) sparse array
        Column i gives the deformation of pad i or ballast i [-]; under a sleeper that bends, the
        weighted mean that drives state-dependent ballast.
    beds : (N, N) sparse array
        Stiffness of the beds where each has one in all [-].
    dampers : (N, d) sparse array
        Directions that span the damping forces of the low modes.
    mass, damping, stiffness : (N, N) sparse array
        The whole track.
    """

    numbering: Numbering
    rail_stiffness: sp.csc_array
    rail_mass: sp.csc_array
    pad_incidence: sp.csc_array
    ballast_incidence: sp.csc_array
    beds: sp.csc_array
    dampers: sp.csc_array
    mass: sp.csc_array
    damping: sp.csc_array
    stiffness: sp.csc_array


def number_dofs(parameters: TrackParameters) -> Numbering:
    """Number the degrees of freedom along the rail."""
    return _number(parameters, half_sleeper(parameters))


def _number(parameters: TrackParameters, half: HalfSleeper) -> Numbering:
    nodes = parameters.elements + 1
    per_bay = parameters.elements_per_bay
    support_node = per_bay * np.arange(1, parameters.bays, dtype=np.intp)
    rail = np.full((nodes, 2), -1, dtype=np.intp)
    inner = np.arange(1, nodes - 1)
    sleepers_before = (inner - 1) // per_bay  # a sleeper is numbered right after its rail node
    rail[1:-1, 0] = 2 * (inner - 1) + half.size * sleepers_before
    rail[1:-1, 1] = rail[1:-1, 0] + 1
    sleeper_dofs = rail[support_node, 1][:, None] + 1 + np.arange(half.size)
    return Numbering(
        rail=rail,
        sleeper=sleeper_dofs[:, half.seat],
        sleeper_dofs=sleeper_dofs,
        support_node=support_node,
        size=2 * (nodes - 2) + half.size * parameters.supports,
    )


def assemble(parameters: TrackParameters) -> TrackMatrices:
    """Assemble mass, damping and stiffness of the track with clamped rail ends."""
    half = half_sleeper(parameters)
    numbering = _number(parameters, half)
    length = parameters.element_length
    rail_stiffness = _assemble_rail(stiffness_matrix(parameters.section, length), numbering)
    rail_mass = _assemble_rail(mass_matrix(parameters.section, length), numbering)
    pad, ballast = _incidences(numbering, half)
    pads, beds = pad @ pad.T, _on_sleepers(half.bed, numbering)
    stiffness = (
        rail_stiffness + parameters.pad_stiffness * pads + parameters.ballast_stiffness * beds
    )
    bed_forces = _under_sleepers(half.bed_forces(DAMPED_SHAPES), numbering)
    return TrackMatrices(
        numbering=numbering,
        rail_stiffness=rail_stiffness,
        rail_mass=rail_mass,
        pad_incidence=pad,
        ballast_incidence=ballast,
        beds=beds,
        dampers=sp.csc_array(sp.hstack([pad, bed_forces])),
        mass=sp.csc_array(rail_mass + _on_sleepers(half.mass, numbering)),
        damping=sp.csc_array(parameters.pad_damping * pads + parameters.ballast_damping * beds),
        stiffness=sp.csc_array(stiffness + _on_sleepers(half.stiffness, numbering)),
    )


def half_bandwidth(*matrices: sp.csc_array) -> int:
    """Largest distance of an entry of symmetric matrices from the diagonal."""
    widths = [0]
    for matrix in matrices:
        entries = matrix.tocoo()
        widths.append(int(np.max(np.abs(entries.row - entries.col), initial=0)))
    return max(widths)


def to_banded(matrix: sp.csc_array, width: int | None = None) -> FloatArray:
    """Lower band storage, shape (width + 1, N), of a symmetric matrix.

    Parameters
    ----------
    matrix : (N, N) sparse array
        The matrix.
    width : int, optional
        At least its half-bandwidth, which it is by default.
    """
    size = matrix.shape[0]
    width = half_bandwidth(matrix) if width is None else width
    banded = np.zeros((width + 1, size))
    for k in range(min(width + 1, size)):
        banded[k, : size - k] = matrix.diagonal(-k)
    return banded


def _assemble_rail(element: FloatArray, numbering: Numbering) -> sp.csc_array:
    """Sum the same element matrix along the rail; clamped degrees of freedom are left out."""
    dofs = np.hstack([numbering.rail[:-1], numbering.rail[1:]])
    rows = np.repeat(dofs, 4, axis=1).ravel()
    columns = np.tile(dofs, (1, 4)).ravel()
    values = np.tile(element.ravel(), len(dofs))
    free = (rows >= 0) & (columns >= 0)
    shape = (numbering.size, numbering.size)
    return sp.csc_array(sp.coo_array((values[free], (rows[free], columns[free])), shape=shape))


def _incidences(numbering: Numbering, half: HalfSleeper) -> tuple[sp.csc_array, sp.csc_array]:
    """Incidence of pad deformation (rail minus rail seat) and ballast deformation."""
    supports = np.arange(len(numbering.sleeper))
    ones = np.ones(len(supports))
    shape = (numbering.size, len(supports))
    rail = numbering.rail[numbering.support_node, 0]
    on_rail = sp.coo_array((ones, (rail, supports)), shape=shape)
    on_seat = sp.coo_array((ones, (numbering.sleeper, supports)), shape=shape)
    return sp.csc_array(on_rail - on_seat), _under_sleepers(half.spread[:, None], numbering)


def _under_sleepers(columns: FloatArray, numbering: Numbering) -> sp.csc_array:
    """Columns for one sleeper, shape (s, k), as those of all, shape (N, supports * k)."""
    supports, count = len(numbering.sleeper), columns.shape[1]
    rows = np.repeat(numbering.sleeper_dofs, count, axis=1).ravel()
    places = np.arange(supports)[:, None, None] * count + np.arange(count)
    places = np.broadcast_to(places, (supports, len(columns), count)).ravel()
    values = np.tile(columns.ravel(), supports)
    shape = (numbering.size, supports * count)
    return sp.csc_array(sp.coo_array((values, (rows, places)), shape=shape))


def _on_sleepers(block: FloatArray, numbering: Numbering) -> sp.csc_array:
    """A matrix of one sleeper, shape (s, s), on every sleeper of the track, shape (N, N)."""
    dofs = numbering.sleeper_dofs
    rows = np.repeat(dofs, len(block), axis=1).ravel()
    columns = np.tile(dofs, (1, len(block))).ravel()
    values = np.tile(block.ravel(), len(dofs))
    shape = (numbering.size, numbering.size)
    return sp.csc_array(sp.coo_array((values, (rows, columns)), shape=shape))
