"""Nonlinear static equilibrium of the track under standing or steadily moving wheels."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .beam_element import FloatArray
from .components import ActiveComponents
from .contact_point import RailPoint
from .reduction import ReducedTrack
from .track_state import TrackState

MAX_SWEEPS = 400
TOLERANCE = 1e-12  # relative change of the force increments
SMALLEST_SHARE = 1e-3  # of a change
OVERSHOOT = 0.1  # slope of the energy behind a change over the fall before it
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
    the equilibrium is that of the untruncated track. Dampers of stiff laws bear nothing in it,
    and their increments' rates are found once, after the increments: where gaps are about to close
    rates would switch on and off without end.

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
        motion = np.zeros_like(rate) if active.stiff else rate
        miss = active.force(deformation, motion) - increment
        if active.stiff and search.is_too_far(miss):
            increment = search.shorter()
            continue
        tangent = active.tangents(deformation, motion).stiffness
        matrix = np.eye(active.count) + tangent[:, None] * compliance
        change = _solve(matrix, miss)
        search.begin(increment, change, compliance, miss)
        # the rate with the present increment rate taken out, then solved for both together
        free_rate = rate + (compliance - active.flexibility) @ increment_rate
        new_rate = np.linalg.solve(matrix, tangent * free_rate)
        rate_change, increment = new_rate - increment_rate, increment + change
        scale = TOLERANCE * float(np.max(np.abs(increment)))  # N, and N/s for the rates
        found = bool(np.max(np.abs(change)) <= scale)
        if active.stiff and not found:
            continue
        increment_rate = new_rate
        rate_scale = TOLERANCE * float(np.max(np.abs(increment_rate))) + scale
        if found and (search.is_last or np.max(np.abs(rate_change)) <= rate_scale):
            break
        search = _LineSearch(is_last=active.stiff)
    else:
        raise RuntimeError(
            f"track: no static equilibrium found in {MAX_SWEEPS} sweeps under the contact forces "
            f"{', '.join(f'{force:.6g}' for force in forces)} N; check the ballast and pad laws"
        )
    _refuse_falling(track, active, deformation)
    active.remember(state.pads, deformation, np.zeros_like(deformation))
    state.force[:], state.force_rate[:], state.speed[:] = forces, 0.0, speed
    _keep(state.increment, active, increment)
    _keep(state.increment_rate, active, increment_rate)
    state.modal[:], state.load[:] = modal, load
    state.displacement[:] = np.real((contact * weight) @ modal)
    state.displacement += np.array([w.shape @ residual[w.rows] for w in wheels]) @ forces
    state.displacement -= residual[active.rows].T @ increment


def _solve(matrix: FloatArray, miss: FloatArray) -> FloatArray:
    """Newton's change of the increments [N], shape (c,)."""
    try:
        return np.asarray(np.linalg.solve(matrix, miss))
    except np.linalg.LinAlgError as error:
        raise RuntimeError(
            "track: a part of the track is held by nothing in static equilibrium; use loads on "
            "ballast and pads that rise with displacement"
        ) from error


def _keep(values: FloatArray, active: ActiveComponents, own: FloatArray) -> None:
    """Set the values of the active components, and zero for all others."""
    values[:] = 0.0
    values[active.number] = own


class _LineSearch:
    """Shortens changes that lead uphill; where gaps close, Newton's full one may.

    The energy of the track is convex where all loads rise with displacement. Along a change
    ``d`` of the increments its slope is ``-(C d) . miss``, with the compliance ``C``.

    Attributes
    ----------
    is_last : bool
        Whether the rates of the increments are those of the equilibrium.
    """

    def __init__(self, *, is_last: bool = False) -> None:
        self.is_last = is_last
        self._share = 0.0

    def begin(
        self, start: FloatArray, change: FloatArray, compliance: FloatArray, miss: FloatArray
    ) -> None:
        """Note a change from a start where so much is missed."""
        self._start, self._change = start, change
        self._weight = compliance @ change
        self._share, self._fall = 1.0, float(self._weight @ miss)

    def is_too_far(self, miss: FloatArray) -> bool:
        """Whether the energy rises where the change ends, and the change can be shortened."""
        if not self._share > SMALLEST_SHARE:
            return False
        return float(self._weight @ miss) < -OVERSHOOT * self._fall

    def shorter(self) -> FloatArray:
        """Return what half of the change before leads to."""
        self._share *= 0.5
        return self._start + self._share * self._change


def _refuse_falling(track: ReducedTrack, active: ActiveComponents, deformation: FloatArray) -> None:
    """Refuse an equilibrium on a falling branch of a characteristic."""
    if active.count == 0:
        return
    own, supports = track.parameters, track.parameters.supports
    linear = np.where(active.number < supports, own.ballast_stiffness, own.pad_stiffness)
    whole = active.tangents(deformation, np.zeros_like(deformation)).stiffness + linear
    worst = int(np.argmin(whole / linear))
    if whole[worst] < -ROUNDING * linear[worst]:
        kind = "ballast" if active.number[worst] < supports else "pad"
        support = active.first_support + active.number[worst] % supports + 1
        raise RuntimeError(
            f"track: the load on the {kind} of support {support} falls "
            f"with its displacement at {deformation[worst]:.3g} m ({whole[worst]:.3g} N/m): the "
            "static equilibrium is not the only one; use a law whose load rises"
        )
