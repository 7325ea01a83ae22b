"""The whole finite element track, without modes: nodal displacements and velocities as the state.

``mass = diag(I, M)`` and ``matrix = [[0, I], [-K, -C]]`` are sparse and stay so.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp
from scipy.linalg import cho_solve_banded, cholesky_banded

from track_fmu.assembly import TrackMatrices, to_banded
from track_fmu.reduction import moment_operators
from track_fmu.sleeper_observation import sleeper_operators

from .linear_track import BedAccelerations, BentSleepers, Feedthrough, Matrix, Ports

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from track_fmu.parameters import TrackParameters

FREQUENCY = 1e4
"""Velocities are tolerated to be wrong by this times the tolerance of displacements [rad/s]."""


class FullTrack:
    """The track of Eq. (2) in physical coordinates; see `LinearTrack`.

    Parameters
    ----------
    parameters : TrackParameters
        The track.
    matrices : TrackMatrices
        The same, assembled; its supports may differ.
    pad_ports : bool
        Whether pads have ports.
    """

    def __init__(
        self, parameters: TrackParameters, matrices: TrackMatrices, *, pad_ports: bool
    ) -> None:
        self.parameters = parameters
        self._matrices = matrices
        size = matrices.numbering.size
        unit = sp.eye_array(size, format="csc")
        self.mass: sp.csc_array | None = sp.csc_array(sp.block_diag([unit, matrices.mass]))
        self.matrix: Matrix = sp.csc_array(
            sp.block_array([[0.0 * unit, unit], [-matrices.stiffness, -matrices.damping]])
        )
        self.scale = np.concatenate((np.ones(size), np.full(size, FREQUENCY)))
        self._factor = cholesky_banded(to_banded(matrices.mass), lower=True)
        self._stiffness = sp.csr_array(matrices.stiffness)
        self._damping = sp.csr_array(matrices.damping)
        supports = sp.csr_array(port_incidence(matrices, pad_ports=pad_ports).T)
        nothing = sp.csr_array(supports.shape)
        on_velocity = sp.csc_array(sp.hstack([nothing, supports]))
        self.supports = Ports(
            sp.csc_array(sp.hstack([supports, nothing])), on_velocity, on_velocity
        )
        self._dofs = np.hstack([matrices.numbering.rail[:-1], matrices.numbering.rail[1:]])
        self._moments = moment_operators(parameters, matrices)
        self._sleepers = sleeper_operators(parameters, matrices)

    @cached_property
    def beds(self) -> BedAccelerations:
        """See `LinearTrack.beds`; sleepers share no mass with the rail or with each other."""
        matrices = self._matrices
        sleepers = matrices.ballast_incidence
        answer = sp.csr_array(
            cho_solve_banded((self._factor, True), sleepers.toarray(), check_finite=False).T
        )
        return BedAccelerations(
            sp.csr_array(sp.hstack([-answer @ self._stiffness, -answer @ self._damping])),
            (answer @ sleepers).diagonal(),
            (answer @ matrices.pad_incidence).diagonal(),
        )

    @property
    def _size(self) -> int:
        return self._matrices.numbering.size

    def begin(
        self, displacement: NDArray[np.float64], velocity: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """See `LinearTrack.begin`."""
        return np.concatenate((displacement, velocity))

    def advance(self, state: NDArray[np.float64], load: NDArray[np.float64]) -> NDArray[np.float64]:
        """See `LinearTrack.advance`."""
        displacement, velocity = state[: self._size], state[self._size :]
        force = load[self._size :] - self._stiffness @ displacement - self._damping @ velocity
        acceleration = cho_solve_banded((self._factor, True), force, check_finite=False)
        return np.concatenate((velocity, acceleration))

    def wheels(self, elements: NDArray[np.intp], weights: NDArray[np.float64]) -> Ports:
        """See `LinearTrack.wheels`."""
        count = len(elements)
        rows = np.zeros((count, self._size + 1))  # the last column takes what is clamped
        rows[np.arange(count)[:, None], self._dofs[elements]] = weights
        nothing = np.zeros((count, self._size))
        on_velocity = np.hstack([nothing, rows[:, :-1]])
        return Ports(np.hstack([rows[:, :-1], nothing]), on_velocity, on_velocity)

    def feedthrough(
        self, elements: NDArray[np.intp], weights: NDArray[np.float64]
    ) -> Feedthrough | None:
        """Return None: a force moves nothing at once."""
        del elements, weights
        return None

    def nodal_moments(
        self,
        nodes: NDArray[np.intp],
        states: NDArray[np.float64],
        rates: NDArray[np.float64],
        loads: NDArray[np.float64],
    ) -> NDArray[np.float64]:
        """See `LinearTrack.nodal_moments`: ``K_e x + M_e x''``."""
        del loads
        static, inertial = self._moments
        displacement, acceleration = states[: self._size], rates[self._size :]
        return np.asarray(static[nodes] @ displacement + inertial[nodes] @ acceleration)

    def pads(
        self,
        states: NDArray[np.float64],
        rates: NDArray[np.float64],
        loads: NDArray[np.float64],
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """See `LinearTrack.pads`."""
        del loads
        incidence = self._matrices.pad_incidence.T
        return incidence @ states[: self._size], incidence @ rates[: self._size]

    def bent_sleepers(
        self,
        states: NDArray[np.float64],
        rates: NDArray[np.float64],
        loads: NDArray[np.float64],
    ) -> BentSleepers:
        """See `LinearTrack.bent_sleepers`: moments from the forces at an end of an element."""
        own = self._sleepers
        displacement, velocity = states[: self._size], states[self._size :]
        nodal = 2 * (self.parameters.elements + 1)
        spread = own.spread @ loads[nodal : nodal + own.spread.shape[1]]
        inertia = own.inertial @ rates[self._size :]
        seen = own.static @ displacement + own.viscous @ velocity + inertia - spread
        at_seat, at_centre, mean = np.split(np.asarray(seen), 3)
        return BentSleepers(
            seat=displacement[self._matrices.numbering.sleeper],
            mean=mean,
            mean_rate=np.asarray(own.static @ velocity)[2 * len(mean) :],
            moments=(at_seat, at_centre),
        )


def port_incidence(matrices: TrackMatrices, *, pad_ports: bool) -> sp.csc_array:
    """Return what deforms ballast, and pads if they have ports, one column a port, (N, ports)."""
    if not pad_ports:
        return matrices.ballast_incidence
    return sp.csc_array(sp.hstack([matrices.ballast_incidence, matrices.pad_incidence]))
