"""Nonlinear static equilibrium of the track under standing or steadily moving wheels."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .beam_element import FloatArray
from .components import ActiveComponents
from .contact_point import RailPoint
from .reduction import ReducedTrack
from .track_state import TrackState

MAX_SWEEPS = 100
TOLERANCE = 1e-12  # relative change of the force increments


def static_start(
    state: TrackState,
    track: ReducedTrack,
    active: ActiveComponents,
    *,
    wheels: Sequence[RailPoint],
    forces: FloatArray,
    speed: float,
) -> None:
    """Put the state in equilibrium with the contact forces and the force increments.

    The modal states follow the moving load quasi-steadily: ``q = -Q / lambda - Q' / lambda^2``,
    with ``Q'`` from the speed of the wheels. Residual flexibility completes the displacements, so
    the equilibrium is that of the untruncated track.

    Parameters
    ----------
    state : TrackState
        Overwritten, but for the wheel positions.
    track : ReducedTrack
        Modes and residual flexibility.
    active : ActiveComponents
        Components whose force increments are accounted for.
    wheels : sequence of RailPoint
        Where the wheels stand.
    forces : (wheels,) float array
        Contact forces [N].
    speed : float
        Of all wheels [m/s].

    Raises
    ------
    RuntimeError
        If the force increments do not converge.
    """
    eigenvalues, weight = track.eigenvalues, track.weight
    contact = np.array([w.shape @ track.shape[w.rows] for w in wheels])
    slope = np.array([w.slope @ track.shape[w.rows] for w in wheels])
    residual = np.array([track.flexibility[:, w.rows] @ w.shape for w in wheels]).T
    weighted = active.shape * weight
    compliance = active.flexibility - np.real((weighted / eigenvalues) @ active.shape.T)
    contact_load, contact_load_rate = forces @ contact, speed * (forces @ slope)

    increment, increment_rate = np.zeros(active.count), np.zeros(active.count)
    for _ in range(MAX_SWEEPS):
        load = contact_load - increment @ active.shape
        load_rate = contact_load_rate - increment_rate @ active.shape
        modal = -(load + load_rate / eigenvalues) / eigenvalues
        deformation = np.real(weighted @ modal)
        deformation += residual[active.rows] @ forces - active.flexibility @ increment
        rate = np.real(weighted @ (eigenvalues * modal + load))
        if active.count == 0:
            break
        tangent = active.stiffness(deformation)
        matrix = np.eye(active.count) + tangent[:, None] * compliance
        change = np.linalg.solve(matrix, active.force(deformation, rate) - increment)
        # the rate with the present increment rate taken out, then solved for both together
        free_rate = rate + (compliance - active.flexibility) @ increment_rate
        new_rate = np.linalg.solve(matrix, tangent * free_rate)
        rate_change = new_rate - increment_rate
        increment, increment_rate = increment + change, new_rate
        scale = TOLERANCE * float(np.max(np.abs(increment)))  # N, and N/s for the rates
        rate_scale = TOLERANCE * float(np.max(np.abs(increment_rate))) + scale
        if np.max(np.abs(change)) <= scale and np.max(np.abs(rate_change)) <= rate_scale:
            break
    else:
        raise RuntimeError(
            f"track: no static equilibrium found in {MAX_SWEEPS} sweeps under the contact forces "
            f"{', '.join(f'{force:.6g}' for force in forces)} N; check the ballast and pad laws"
        )
    state.force[:], state.force_rate[:], state.speed[:] = forces, 0.0, speed
    state.increment[:], state.increment_rate[:] = 0.0, 0.0
    state.increment[active.number] = increment
    state.increment_rate[active.number] = increment_rate
    state.modal[:], state.load[:] = modal, load
    state.displacement[:] = np.real((contact * weight) @ modal)
    state.displacement += np.array([w.shape @ residual[w.rows] for w in wheels]) @ forces
    state.displacement -= residual[active.rows].T @ increment
