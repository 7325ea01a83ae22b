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
SMALLEST_SHARE = 1e-3  # of a change
ROUNDING = 1e-9  # of a tangent stiffness


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
        If the force increments do not converge, or the load on a component falls with its
        displacement there: then there are other equilibria.
    """
    eigenvalues, weight = track.eigenvalues, track.weight
    contact = np.array([w.shape @ track.shape[w.rows] for w in wheels])
    slope = np.array([w.slope @ track.shape[w.rows] for w in wheels])
    residual = np.array([track.flexibility[:, w.rows] @ w.shape for w in wheels]).T
    weighted = active.shape * weight
    compliance = active.flexibility - np.real((weighted / eigenvalues) @ active.shape.T)
    contact_load, contact_load_rate = forces @ contact, speed * (forces @ slope)

    increment, increment_rate = np.zeros(active.count), np.zeros(active.count)
    search = _LineSearch()
    for _ in range(MAX_SWEEPS):
        load = contact_load - increment @ active.shape
        load_rate = contact_load_rate - increment_rate @ active.shape
        modal = -(load + load_rate / eigenvalues) / eigenvalues
        deformation = np.real(weighted @ modal)
        deformation += residual[active.rows] @ forces - active.flexibility @ increment
        rate = np.real(weighted @ (eigenvalues * modal + load))
        if active.count == 0:
            break
        if active.stiff and search.is_under_way:
            missed = active.force(deformation, search.rate) - increment
            if search.is_too_far(missed):
                increment = search.shorter()
                continue
        miss = active.force(deformation, rate) - increment
        tangent = active.stiffness(deformation, rate)
        matrix = np.eye(active.count) + tangent[:, None] * compliance
        change = np.asarray(np.linalg.solve(matrix, miss))
        search.begin(increment, change, rate, miss)
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
    _refuse_falling(track, active, deformation, rate)
    active.remember(state.pads, deformation, rate)
    state.force[:], state.force_rate[:], state.speed[:] = forces, 0.0, speed
    state.increment[:], state.increment_rate[:] = 0.0, 0.0
    state.increment[active.number] = increment
    state.increment_rate[active.number] = increment_rate
    state.modal[:], state.load[:] = modal, load
    state.displacement[:] = np.real((contact * weight) @ modal)
    state.displacement += np.array([w.shape @ residual[w.rows] for w in wheels]) @ forces
    state.displacement -= residual[active.rows].T @ increment


class _LineSearch:
    """Shortens changes that make matters worse; where gaps close, Newton's full one may.

    Attributes
    ----------
    rate : (c,) float array
        Rates of deformation at which what is missed is compared: the rates change by themselves.
    """

    def __init__(self) -> None:
        self._share, self._size = 0.0, np.inf

    @property
    def is_under_way(self) -> bool:
        """Whether a change has begun."""
        return self._share > 0.0

    def begin(
        self, start: FloatArray, change: FloatArray, rate: FloatArray, miss: FloatArray
    ) -> None:
        """Note a change from a start where so much is missed, at given rates of deformation."""
        self._start, self._change, self.rate = start, change, rate
        self._share, self._size = 1.0, float(np.max(np.abs(miss)))

    def is_too_far(self, miss: FloatArray) -> bool:
        """Whether more is missed than at the start, and the change can be shortened."""
        return self._share > SMALLEST_SHARE and float(np.max(np.abs(miss))) > self._size

    def shorter(self) -> FloatArray:
        """Return what half of the change before leads to."""
        self._share *= 0.5
        return self._start + self._share * self._change


def _refuse_falling(
    track: ReducedTrack, active: ActiveComponents, deformation: FloatArray, rate: FloatArray
) -> None:
    """Refuse an equilibrium on a falling branch of a characteristic."""
    if active.count == 0:
        return
    own, supports = track.parameters, track.parameters.supports
    linear = np.where(active.number < supports, own.ballast_stiffness, own.pad_stiffness)
    whole = active.stiffness(deformation, np.zeros_like(rate)) + linear
    worst = int(np.argmin(whole / linear))
    if whole[worst] < -ROUNDING * linear[worst]:
        kind = "ballast" if active.number[worst] < supports else "pad"
        raise RuntimeError(
            f"track: the load on the {kind} of support {active.number[worst] % supports + 1} falls "
            f"with its displacement at {deformation[worst]:.3g} m ({whole[worst]:.3g} N/m): the "
            "static equilibrium is not the only one; use a law whose load rises"
        )
