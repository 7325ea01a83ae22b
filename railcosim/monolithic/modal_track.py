"""The track in complex modal coordinates, Eq. (6)-(14): real and imaginary parts as the state.

The retained modes ``q' = lambda q + Q`` are decoupled; the others answer at once with the residual
flexibility of Eq. (13).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .linear_track import BentSleepers, Feedthrough, Matrix, Ports

if TYPE_CHECKING:
    import scipy.sparse as sp
    from numpy.typing import NDArray

    from track_fmu.assembly import TrackMatrices
    from track_fmu.modal import ModalBasis
    from track_fmu.reduction import ReducedTrack

    Complex = NDArray[np.complex128]


SHARE = 0.1
"""What one mode may be wrong by in displacement, over what all of them may."""


class ModalTrack:
    """The track of Eq. (10) in modal coordinates; see `LinearTrack`.

    Parameters
    ----------
    reduced : ReducedTrack
        Modes and residual flexibility in coordinates.
    matrices : TrackMatrices
        The same track, assembled.
    basis : ModalBasis
        Its retained modes.
    pad_ports : bool
        Whether pads have ports.
    """

    mass: sp.csc_array | None = None
    beds = None  # the accelerations of the modes that are left out are not known

    def __init__(
        self,
        reduced: ReducedTrack,
        matrices: TrackMatrices,
        basis: ModalBasis,
        *,
        pad_ports: bool,
    ) -> None:
        self.parameters = reduced.parameters
        self._track, self._matrices, self._basis = reduced, matrices, basis
        decay, frequency = np.diag(basis.eigenvalues.real), np.diag(basis.eigenvalues.imag)
        self.matrix: Matrix = np.block([[decay, -frequency], [frequency, decay]])
        largest = np.abs(basis.modes).max(axis=0)
        self.scale = np.tile(SHARE / largest, 2)
        last = reduced.pad_rows if pad_ports else reduced.ballast_rows
        self._port_rows = slice(reduced.ballast_rows.start, last.stop)
        shape = reduced.shape[self._port_rows]
        self.supports = self._ports(shape)
        self._pads = np.asarray(self._ports(reduced.shape[reduced.pad_rows]).output)
        self._weighted = shape * reduced.weight
        self._constant = Feedthrough(
            reduced.flexibility[self._port_rows, self._port_rows],
            np.real(self._weighted @ shape.T),
        )

    def begin(
        self, displacement: NDArray[np.float64], velocity: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """See `LinearTrack.begin`: ``q = p^T A y``, with ``a_n = 1`` in Eq. (11a)."""
        matrices, modes = self._matrices, self._basis.modes
        momentum = matrices.damping @ displacement + matrices.mass @ velocity
        inertia = self._basis.eigenvalues * (modes.T @ (matrices.mass @ displacement))
        coordinates = modes.T @ momentum + inertia
        return np.concatenate((coordinates.real, coordinates.imag))

    def advance(self, state: NDArray[np.float64], load: NDArray[np.float64]) -> NDArray[np.float64]:
        """See `LinearTrack.advance`."""
        real, imaginary = np.split(state, 2)
        rate = self._basis.eigenvalues * (real + 1j * imaginary)
        return np.concatenate((rate.real, rate.imag)) + load

    def wheels(self, elements: NDArray[np.intp], weights: NDArray[np.float64]) -> Ports:
        """See `LinearTrack.wheels`."""
        return self._ports(self._wheel_shape(elements, weights))

    def feedthrough(
        self, elements: NDArray[np.intp], weights: NDArray[np.float64]
    ) -> Feedthrough | None:
        """See `LinearTrack.feedthrough`: the residual, and ``Re(rho rho^T)`` of the retained."""
        track, count = self._track, len(elements)
        rows = _rows(elements)
        shape = self._wheel_shape(elements, weights)
        ports = count + len(self._weighted)
        flexibility, mobility = np.empty((ports, ports)), np.empty((ports, ports))
        flexibility[count:, count:], mobility[count:, count:] = self._constant
        answer = np.einsum("nwk,wk->nw", track.flexibility[:, rows], weights)
        flexibility[count:, :count] = answer[self._port_rows]
        flexibility[:count, :count] = np.einsum("wkv,wk->wv", answer[rows], weights)
        mobility[count:, :count] = np.real(self._weighted @ shape.T)
        mobility[:count, :count] = np.real((shape * track.weight) @ shape.T)
        flexibility[:count, count:] = flexibility[count:, :count].T
        mobility[:count, count:] = mobility[count:, :count].T
        return Feedthrough(flexibility, mobility)

    def nodal_moments(
        self,
        nodes: NDArray[np.intp],
        states: NDArray[np.float64],
        rates: NDArray[np.float64],
        loads: NDArray[np.float64],
    ) -> NDArray[np.float64]:
        """See `LinearTrack.nodal_moments`: modes and residual."""
        del rates
        output = self._ports(self._track.moment_shape[nodes]).output
        flexibility = self._track.moment_flexibility[nodes, : len(loads)]
        return np.asarray(output @ states + flexibility @ loads)

    def pads(
        self,
        states: NDArray[np.float64],
        rates: NDArray[np.float64],
        loads: NDArray[np.float64],
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """See `LinearTrack.pads`; the rate is that of the retained modes, Eq. (22)."""
        flexibility = self._track.flexibility[self._track.pad_rows, : len(loads)]
        return self._pads @ states + flexibility @ loads, self._pads @ rates

    def bent_sleepers(
        self,
        states: NDArray[np.float64],
        rates: NDArray[np.float64],
        loads: NDArray[np.float64],
    ) -> BentSleepers:
        """See `LinearTrack.bent_sleepers`; the rate is that of the retained modes."""
        track = self._track
        output = self._ports(track.sleeper_shape).output
        seen = output @ states + track.sleeper_flexibility[:, : len(loads)] @ loads
        at_seat, at_centre, mean = np.split(np.asarray(seen), 3)
        # a rail seat moves as the rail above it less the deformation of the pad between them
        shape = track.shape[track.seat_rows] - track.shape[track.pad_rows]
        flexibility = track.flexibility[track.seat_rows] - track.flexibility[track.pad_rows]
        return BentSleepers(
            seat=self._ports(shape).output @ states + flexibility[:, : len(loads)] @ loads,
            mean=mean,
            mean_rate=np.asarray(output @ rates)[2 * len(mean) :],
            moments=(at_seat, at_centre),
        )

    def _wheel_shape(self, elements: NDArray[np.intp], weights: NDArray[np.float64]) -> Complex:
        return np.asarray(np.einsum("wk,wks->ws", weights, self._track.shape[_rows(elements)]))

    def _ports(self, shape: Complex) -> Ports:
        """Ports of given modal displacements, shape (p, S)."""
        weighted = shape * self._track.weight
        fast = weighted * self._basis.eigenvalues
        return Ports(
            np.hstack([weighted.real, -weighted.imag]),
            np.hstack([fast.real, -fast.imag]),
            np.hstack([shape.real, shape.imag]),
        )


def _rows(elements: NDArray[np.intp]) -> NDArray[np.intp]:
    """Coordinates of the elements' nodes, shape (wheels, 4)."""
    return np.asarray(2 * elements[:, None] + np.arange(4))
