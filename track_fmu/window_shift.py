"""Moves the window of an endless track by whole bays, through the physical state.

Displacements and velocities of all nodes and sleepers, the truncated modes' static part included,
are those of the nodes that many bays further on, and so are all degrees of freedom of sleepers
that bend; what enters the window is at rest. The modes'
biorthogonality, Eq. (7)-(11), gives the modal states back, for ``a_n = 1``:

    q_n = rho_n^T (C x + M x') + lambda_n rho_n^T M x

For the uniform linear track that is exact but for what the window's clamped ends and the truncated
modes' dynamics change.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .assembly import IntArray, assemble
from .beam_element import FloatArray
from .contact_point import RailPoint
from .eigensolver import ComplexArray
from .reduction import ReducedTrack
from .track_state import TrackState


class WindowShift:
    """Moves states of a track by whole bays.

    Parameters
    ----------
    track : ReducedTrack
        Modes and residual flexibility.
    """

    def __init__(self, track: ReducedTrack) -> None:
        matrices = assemble(track.parameters)
        self._track, self._numbering = track, matrices.numbering
        self._mass, self._damping = matrices.mass, matrices.damping
        rail, sleepers = matrices.numbering.rail, matrices.numbering.sleeper_dofs.ravel()
        rigid = track.parameters.sleeper == "rigid"
        # the degrees of freedom of nodes, then of sleepers, and their rows
        self._dofs: IntArray = np.concatenate((rail[rail >= 0], sleepers))
        nodes = np.flatnonzero(rail.ravel() >= 0)
        below = track.ballast_rows
        self._shape: ComplexArray = np.vstack(
            (track.shape[nodes], track.shape[below] if rigid else track.bent_shape)
        )
        self._flexibility: FloatArray = np.vstack(
            (
                track.flexibility[nodes],
                track.flexibility[below] if rigid else track.bent_flexibility,
            )
        )

    def apply(
        self,
        state: TrackState,
        bays: int,
        *,
        forces: FloatArray,
        wheels: Sequence[RailPoint],
    ) -> None:
        """Move the window.

        Parameters
        ----------
        state : TrackState
            Changed in place, but for the offset.
        bays : int
            How far the window moves.
        forces : (n,) float array
            On the coordinates, before.
        wheels : sequence of RailPoint
            Where the wheels stand in the moved window.
        """
        track, shape = self._track, self._shape
        rate = track.weight * (track.eigenvalues * state.modal + state.load)
        modal = np.real(shape @ (track.weight * state.modal))
        displacement = self._moved(modal + self._flexibility @ forces, bays)
        velocity = self._moved(np.real(shape @ rate), bays)
        momentum = self._damping @ displacement + self._mass @ velocity
        state.modal[:] = momentum[self._dofs] @ shape
        state.modal += track.eigenvalues * ((self._mass @ displacement)[self._dofs] @ shape)
        supports = track.parameters.supports
        for values in (state.increment, state.increment_rate):
            for kind in values.reshape(-1, supports):
                kind[:] = _shifted(kind, bays)
        for memory in state.pads:
            memory[:] = _shifted(memory, bays)
        self._press(state, wheels)

    def _press(self, state: TrackState, wheels: Sequence[RailPoint]) -> None:
        """Make modal loads and displacements under the wheels those of the moved state."""
        track, first = self._track, self._track.ballast_rows.start
        loads = np.zeros(len(track.flexibility))
        loads[first:] = -state.increment
        for wheel, force in zip(wheels, state.force, strict=True):
            loads[wheel.rows] += force * wheel.shape
        state.load[:] = loads @ track.shape
        modal = track.weight * state.modal
        for i, wheel in enumerate(wheels):
            rail = np.real(track.shape[wheel.rows] @ modal) + track.flexibility[wheel.rows] @ loads
            state.displacement[i] = wheel.shape @ rail

    def _moved(self, values: FloatArray, bays: int) -> FloatArray:
        """Values of all degrees of freedom, those of the nodes and sleepers further on."""
        rail, sleepers = self._numbering.rail, self._numbering.sleeper_dofs
        nodes = np.zeros(rail.shape)
        held = int(np.count_nonzero(rail >= 0))
        nodes[rail >= 0] = values[:held]
        moved = np.empty_like(values)
        along = _shifted(nodes, bays * self._track.parameters.elements_per_bay)
        moved[rail[rail >= 0]] = along[rail >= 0]
        moved[sleepers] = _shifted(values[held:].reshape(sleepers.shape), bays)
        return moved


def _shifted(values: FloatArray, places: int) -> FloatArray:
    """Rows that many places further on, zeros where there are none."""
    moved = np.zeros_like(values)
    if abs(places) >= len(values):
        return moved
    if places >= 0:
        moved[: len(values) - places] = values[places:]
    else:
        moved[-places:] = values[:places]
    return moved
