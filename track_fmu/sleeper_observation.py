"""What is observed of sleepers that bend, as linear forms of the track's motion and loads."""

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
class SleeperOperators:
    """Rows ``static x + viscous x' + inertial x'' - spread f``, ``m`` in all.

    In this order, each of all sleepers: bending moment at the rail seat, at the centre (sagging
    positive), mean deflection. Rigid sleepers have none. The moments are end couples of elements,
    from which the forces inside an element are taken: its inertia, the linear bed, and the spread
    forces ``f`` on the ballast coordinates.

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
        """Rows of the modes, shape (m, S)."""
        modes, eigenvalues = basis.modes, basis.eigenvalues
        rates = self.viscous @ modes + (self.inertial @ modes) * eigenvalues
        return np.asarray(self.static @ modes + rates * eigenvalues)

    def of_forces(self, coordinates: int) -> FloatArray:
        """What forces on the coordinates do inside the elements, shape (m, coordinates)."""
        rows = np.zeros((len(self.spread), coordinates))
        supports = self.spread.shape[1]
        first = coordinates - 2 * supports  # ballast and pads are the last ones
        rows[:, first : first + supports] = -self.spread
        return rows


def sleeper_operators(parameters: TrackParameters, matrices: TrackMatrices) -> SleeperOperators:
    """Operators of the sleepers of a track."""
    half = half_sleeper(parameters)
    dofs, size = matrices.numbering.sleeper_dofs, matrices.numbering.size
    supports, kinds = len(dofs), 0 if parameters.sleeper == "rigid" else 3

    def on_all(rows: FloatArray) -> sp.csr_array:
        padded = np.zeros((kinds, half.size))
        padded[: len(rows)] = rows
        row = np.repeat(np.arange(kinds * supports), half.size)
        column = np.tile(dofs.ravel(), kinds)
        values = np.repeat(padded[:, None], supports, axis=1).ravel()
        return sp.csr_array(sp.coo_array((values, (row, column)), shape=(kinds * supports, size)))

    couples = half.moment_stiffness + parameters.ballast_stiffness * half.moment_bed
    spread = np.zeros((kinds, supports, supports))
    for kind, couple in enumerate(half.moment_spread.tolist()):
        np.fill_diagonal(spread[kind], couple)
    return SleeperOperators(
        static=on_all(np.vstack([couples, half.mean])[:kinds]),
        viscous=on_all(parameters.ballast_damping * half.moment_bed),
        inertial=on_all(half.moment_mass),
        spread=spread.reshape(kinds * supports, supports),
    )
