"""Assembly of the linear finite element model of the track.

The degrees of freedom are numbered along the rail (deflection and rotation of a node, then the
sleeper below it if there is one), which keeps the half-bandwidth at 4 however long the track is.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from .beam_element import FloatArray, mass_matrix, stiffness_matrix
from .parameters import TrackParameters

HALF_BANDWIDTH = 4
IntArray = NDArray[np.intp]


@dataclass(frozen=True, slots=True, kw_only=True)
class Numbering:
    """Numbers of the degrees of freedom; -1 where the rail is clamped.

    Attributes
    ----------
    rail : (nodes, 2) int array
        Deflection and rotation of every rail node.
    sleeper : (supports,) int array
        Displacement of every sleeper.
    support_node : (supports,) int array
        Rail node above every sleeper.
    size : int
        Number of degrees of freedom.
    """

    rail: IntArray
    sleeper: IntArray
    support_node: IntArray
    size: int


@dataclass(frozen=True, slots=True, kw_only=True)
class TrackMatrices:
    """Linear track ``M x'' + C x' + K x = f`` and the parts it is made of.

    ``K = rail_stiffness + D_p k_p D_p^T + D_b k_b D_b^T`` with the incidence matrices of pads
    (rail minus sleeper) and ballast (sleeper); likewise ``C``; ``M = rail_mass + m_s D_b D_b^T``.

    Attributes
    ----------
    numbering : Numbering
        Where each physical displacement is found.
    rail_stiffness, rail_mass : (N, N) sparse array
        The rail alone [N/m ...], [kg ...].
    pad_incidence, ballast_incidence : (N, supports) sparse array
        Column i gives the deformation of pad or ballast i [-].
    mass, damping, stiffness : (N, N) sparse array
        The whole track.
    """

    numbering: Numbering
    rail_stiffness: sp.csc_array
    rail_mass: sp.csc_array
    pad_incidence: sp.csc_array
    ballast_incidence: sp.csc_array
    mass: sp.csc_array
    damping: sp.csc_array
    stiffness: sp.csc_array


def number_dofs(parameters: TrackParameters) -> Numbering:
    """Number the degrees of freedom along the rail."""
    nodes = parameters.elements + 1
    per_bay = parameters.elements_per_bay
    support_node = per_bay * np.arange(1, parameters.bays, dtype=np.intp)
    rail = np.full((nodes, 2), -1, dtype=np.intp)
    inner = np.arange(1, nodes - 1)
    sleepers_before = (inner - 1) // per_bay  # a sleeper is numbered right after its rail node
    rail[1:-1, 0] = 2 * (inner - 1) + sleepers_before
    rail[1:-1, 1] = rail[1:-1, 0] + 1
    return Numbering(
        rail=rail,
        sleeper=rail[support_node, 1] + 1,
        support_node=support_node,
        size=2 * (nodes - 2) + parameters.supports,
    )


def assemble(parameters: TrackParameters) -> TrackMatrices:
    """Assemble mass, damping and stiffness of the track with clamped rail ends."""
    numbering = number_dofs(parameters)
    length = parameters.element_length
    rail_stiffness = _assemble_rail(stiffness_matrix(parameters.section, length), numbering)
    rail_mass = _assemble_rail(mass_matrix(parameters.section, length), numbering)
    pad, ballast = _incidences(numbering)
    pads, beds = pad @ pad.T, ballast @ ballast.T
    return TrackMatrices(
        numbering=numbering,
        rail_stiffness=rail_stiffness,
        rail_mass=rail_mass,
        pad_incidence=pad,
        ballast_incidence=ballast,
        mass=sp.csc_array(rail_mass + parameters.sleeper_mass * beds),
        damping=sp.csc_array(parameters.pad_damping * pads + parameters.ballast_damping * beds),
        stiffness=sp.csc_array(
            rail_stiffness + parameters.pad_stiffness * pads + parameters.ballast_stiffness * beds
        ),
    )


def to_banded(matrix: sp.csc_array) -> FloatArray:
    """Lower band storage, shape (HALF_BANDWIDTH + 1, N), of a symmetric matrix."""
    size = matrix.shape[0]
    banded = np.zeros((HALF_BANDWIDTH + 1, size))
    for k in range(min(HALF_BANDWIDTH + 1, size)):
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


def _incidences(numbering: Numbering) -> tuple[sp.csc_array, sp.csc_array]:
    """Incidence of pad deformation (rail minus sleeper) and ballast deformation (sleeper)."""
    supports = np.arange(len(numbering.sleeper))
    ones = np.ones(len(supports))
    shape = (numbering.size, len(supports))
    rail = numbering.rail[numbering.support_node, 0]
    on_rail = sp.coo_array((ones, (rail, supports)), shape=shape)
    on_sleeper = sp.coo_array((ones, (numbering.sleeper, supports)), shape=shape)
    return sp.csc_array(on_rail - on_sleeper), sp.csc_array(on_sleeper)
