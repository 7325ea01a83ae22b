"""Bending moments of the sleepers as linear forms of the track's displacements and loads."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp

from .sleeper import half_sleeper

if TYPE_CHECKING:
    from .assembly import TrackMatrices
    from .beam_element import FloatArray
    from .eigensolver import ComplexArray
    from .modal import ModalBasis
    from .parameters import TrackParameters


@dataclass(frozen=True, slots=True, kw_only=True)
class SleeperMoments:
    """Moments ``static x + viscous x' + inertial x'' - spread f``, sagging positive.

    Those at all rail seats come first, then those at all centres, ``m`` in all; a rigid sleeper has
    none. They are the end couples of elements, from which the forces inside an element are taken:
    the inertia, the linear bed, and the evenly spread forces ``f`` on the ballast coordinates.

    Attributes
    ----------
    static, viscous, inertial : (m, N) sparse array
        Of displacements, velocities and accelerations.
    spread : (m, supports) float array
        Of the forces on the ballast coordinates [m].
    """

    static: sp.csr_array
    viscous: sp.csr_array
    inertial: sp.csr_array
    spread: FloatArray

    def of_modes(self, basis: ModalBasis) -> ComplexArray:
        """Modal moments, shape (m, S)."""
        modes, eigenvalues = basis.modes, basis.eigenvalues
        rates = self.viscous @ modes + (self.inertial @ modes) * eigenvalues
        return np.asarray(self.static @ modes + rates * eigenvalues)

    def of_forces(self, coordinates: int) -> FloatArray:
        """What forces on the coordinates do inside the elements, shape (m, coordinates)."""
        moments = np.zeros((len(self.spread), coordinates))
        supports = self.spread.shape[1]
        first = coordinates - 2 * supports  # ballast and pads are the last ones
        moments[:, first : first + supports] = -self.spread
        return moments


def sleeper_moment_operators(
    parameters: TrackParameters, matrices: TrackMatrices
) -> SleeperMoments:
    """Bending moments of the sleepers of a track."""
    half = half_sleeper(parameters)
    dofs, size = matrices.numbering.sleeper_dofs, matrices.numbering.size

    def on_all(rows: FloatArray) -> sp.csr_array:
        supports, places = len(dofs), len(rows)
        row = np.repeat(np.arange(places * supports), half.size)
        column = np.tile(dofs.ravel(), places)
        values = np.repeat(rows[:, None], supports, axis=1).ravel()
        return sp.csr_array(sp.coo_array((values, (row, column)), shape=(places * supports, size)))

    return SleeperMoments(
        static=on_all(half.moment_stiffness + parameters.ballast_stiffness * half.moment_bed),
        viscous=on_all(parameters.ballast_damping * half.moment_bed),
        inertial=on_all(half.moment_mass),
        spread=np.asarray(np.kron(half.moment_spread[:, None], np.eye(len(dofs))), dtype=float),
    )
