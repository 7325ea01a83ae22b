"""One step of the track as a small affine map of the contact forces.

Over a step of given size and wheel positions the displacements under the wheels and at the
state-dependent components depend on the contact forces at its end, ``F``, and on the force
increments there, ``g``, through small matrices only. They are set up once a step, so that a master
that repeats the step with other forces pays for a few small products, not for all modes.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from .answer import Answer
from .beam_element import FloatArray
from .components import ActiveComponents
from .contact_point import RailPoint
from .eigensolver import ComplexArray
from .exponential_step import ExponentialStep
from .reduction import ReducedTrack
from .track_state import TrackState

RELATIVE_TOLERANCE = 1e-13
ABSOLUTE_TOLERANCE = 1e-9  # N
MAX_SWEEPS = 30
MAX_HALVINGS = 6


class StepOperator:
    """The step from a state to given wheel positions, for any contact forces.

    Parameters
    ----------
    state : TrackState
        Where the step starts; not kept.
    track : ReducedTrack
        Modes and residual flexibility.
    active : ActiveComponents
        Components whose force increments are accounted for.
    exponential : ExponentialStep
        Coefficients of the step size.
    step_size : float
        Duration [s].
    positions : (wheels,) float array
        Of the wheels at the end of the step [m].
    wheels : sequence of RailPoint
        The same places on the rail.
    linear : bool
        Whether positions and forces change on straight lines from the last ones, or jump at the
        start of the step and are held.

    Attributes
    ----------
    first_increment : (c,) float array
        Force increments of the active components before the step [N].
    """

    def __init__(
        self,
        state: TrackState,
        track: ReducedTrack,
        active: ActiveComponents,
        exponential: ExponentialStep,
        *,
        step_size: float,
        positions: FloatArray,
        wheels: Sequence[RailPoint],
        linear: bool,
    ) -> None:
        self.step_size, self.linear = step_size, linear
        self.positions = positions.copy()
        self._active = active = active.during(step_size, state.pads)
        self._start = state.flat.copy()
        self.first_increment: FloatArray = state.increment[active.number]
        self._contact: ComplexArray = np.array([w.shape @ track.shape[w.rows] for w in wheels])
        self._end = exponential.end
        self._contact_end = exponential.end if linear else exponential.start + exponential.end
        load = state.load if linear else self._increment_load(state, track)
        self._free: ComplexArray = exponential.decay * state.modal + exponential.start * load
        self._set_up_displacements(track, wheels)
        self._set_up_rates(track)
        self._first_force: FloatArray = state.force.copy()
        self._set_up_correction(self._first_force, self.first_increment)

    def serves(
        self, state: TrackState, step_size: float, positions: FloatArray, linear: bool
    ) -> bool:
        """Whether this operator was made for exactly this step."""
        return (
            step_size == self.step_size
            and linear == self.linear
            and np.array_equal(positions, self.positions)
            and np.array_equal(state.flat, self._start)
        )

    def apply(self, state: TrackState, forces: FloatArray) -> None:
        """Move the state to the end of the step under the contact forces there, shape (wheels,)."""
        self.move(state, forces, self._solve_increments(self.first_increment, forces))

    def displacement(self, forces: FloatArray, increment: FloatArray) -> FloatArray:
        """Rail displacement under the wheels at the end of the step [m], shape (wheels,)."""
        return np.asarray(
            self._free_contact + self._contact_contact @ forces - self._contact_active @ increment
        )

    def demanded(self, forces: FloatArray, increment: FloatArray) -> FloatArray:
        """Force increments that the motion under given forces and increments asks for, (c,) [N]."""
        return self._active.force(
            self._deformation(forces, increment),
            self._free_rate + self._rate_contact @ forces - self._rate_active @ increment,
        )

    def _deformation(self, forces: FloatArray, increment: FloatArray) -> FloatArray:
        """Deformations of the components at the end of the step [m], shape (c,)."""
        return np.asarray(
            self._free_active + self._active_contact @ forces - self._active_active @ increment
        )

    @property
    def stiff(self) -> bool:
        """Whether tangents have to be taken where they are used; see `ComponentLaw.stiff`."""
        return self._active.stiff

    def answer_at(self, forces: FloatArray, increment: FloatArray) -> Answer:
        """How increments and rail displacements answer to forces near those given.

        With the tangents at the start of the step where they serve, as in the increments' own
        iteration: those depend on the state alone.
        """
        if not self.stiff:
            return self._answer
        self._set_up_correction(forces, increment)
        return self._make_answer()

    @cached_property
    def _answer(self) -> Answer:
        return self._make_answer()

    def _make_answer(self) -> Answer:
        increments = self._correction @ (
            self._stiffness[:, None] * self._active_contact
            + self._damping[:, None] * self._rate_contact
        )
        relief = self._contact_active @ self._correction
        return Answer(
            increments=increments,
            displacement=self._contact_contact - self._contact_active @ increments,
            correction=self._correction,
            relief=relief,
        )

    def move(self, state: TrackState, forces: FloatArray, increment: FloatArray) -> None:
        """Move the state to the end of the step under given contact forces and increments there."""
        contact_load = forces @ self._contact
        increment_load = increment @ self._active.shape
        state.modal[:] = self._free + self._contact_end * contact_load - self._end * increment_load
        state.load[:] = contact_load - increment_load
        state.displacement[:] = self.displacement(forces, increment)
        if self._active.remembers:
            self._active.remember(
                state.pads,
                self._deformation(forces, increment),
                self._free_rate + self._rate_contact @ forces - self._rate_active @ increment,
            )
        new_increment = np.zeros_like(state.increment)
        new_increment[self._active.number] = increment
        state.increment_rate[:] = (new_increment - state.increment) / self.step_size
        state.increment[:] = new_increment
        if self.linear:
            state.speed[:] = (self.positions - state.position) / self.step_size
            state.force_rate[:] = (forces - state.force) / self.step_size
        else:
            state.speed[:] = 0.0
            state.force_rate[:] = 0.0
        state.position[:] = self.positions
        state.force[:] = forces

    def _increment_load(self, state: TrackState, track: ReducedTrack) -> ComplexArray:
        """Modal load of the force increments alone, at the start of a step with held inputs."""
        first = track.ballast_rows.start
        held: ComplexArray = state.increment @ track.shape[first : first + len(state.increment)]
        return -held

    def _set_up_displacements(self, track: ReducedTrack, wheels: Sequence[RailPoint]) -> None:
        """Displacements under the wheels and at the components: free, and per force at the end."""
        contact, active = self._contact, self._active
        weighted_contact, weighted_active = contact * track.weight, active.shape * track.weight
        self._free_contact: FloatArray = np.real(weighted_contact @ self._free)
        self._free_active: FloatArray = np.real(weighted_active @ self._free)
        driven_contact = (contact * self._contact_end).T
        driven_active = (active.shape * self._end).T
        residual = np.array([track.flexibility[:, w.rows] @ w.shape for w in wheels]).T
        residual_contact = np.array([w.shape @ residual[w.rows] for w in wheels])
        residual_active = residual[active.rows]
        self._contact_contact: FloatArray = (
            np.real(weighted_contact @ driven_contact) + residual_contact
        )
        self._contact_active: FloatArray = (
            np.real(weighted_contact @ driven_active) + residual_active.T
        )
        self._active_contact: FloatArray = (
            np.real(weighted_active @ driven_contact) + residual_active
        )
        self._active_active: FloatArray = (
            np.real(weighted_active @ driven_active) + active.flexibility
        )

    def _set_up_rates(self, track: ReducedTrack) -> None:
        """Deformation rates of the components: free, and per force at the end.

        The rate is ``Re sum w rho (lambda q + Q)``: the second term vanishes for the complete set
        of modes only.
        """
        rates = self._active.shape * track.weight
        driven = rates * track.eigenvalues
        self._free_rate: FloatArray = np.real(driven @ self._free)
        self._rate_contact: FloatArray = np.real(
            (driven * self._contact_end + rates) @ self._contact.T
        )
        self._rate_active: FloatArray = np.real((driven * self._end + rates) @ self._active.shape.T)

    def _set_up_correction(self, forces: FloatArray, increment: FloatArray) -> None:
        """Inverse Jacobian of the increments' equation, at given forces.

        At those of the step's start it depends on nothing but the state, so that a repeated step
        is the same bit for bit; where that does not serve, it is worked out before every use.
        """
        deformation = self._free_active + self._active_contact @ forces
        deformation -= self._active_active @ increment
        rate = self._free_rate + self._rate_contact @ forces - self._rate_active @ increment
        self._stiffness = stiffness = self._active.stiffness(deformation, rate)
        self._damping = damping = self._active.damping(deformation, rate)
        jacobian = stiffness[:, None] * self._active_active + damping[:, None] * self._rate_active
        self._correction = np.asarray(np.linalg.inv(np.eye(self._active.count) + jacobian))

    def _solve_increments(self, guess: FloatArray, forces: FloatArray) -> FloatArray:
        """Force increments at the end of the step, consistent with the motion they cause.

        Newton's iteration with the Jacobian of the start; shape (components,).
        """
        if self._active.count == 0:
            return guess
        if self.stiff:
            return self._solve_stiffly(guess, forces)
        deformation = self._free_active + self._active_contact @ forces
        rate = self._free_rate + self._rate_contact @ forces
        increment = guess
        with np.errstate(over="ignore", invalid="ignore"):  # divergence is refused below
            for _ in range(MAX_SWEEPS):
                demanded = self._active.force(
                    deformation - self._active_active @ increment,
                    rate - self._rate_active @ increment,
                )
                change = self._correction @ (demanded - increment)
                increment = increment + change
                scale = float(np.max(np.abs(increment)))
                if not np.isfinite(scale):
                    break
                limit = RELATIVE_TOLERANCE * scale + ABSOLUTE_TOLERANCE
                if float(np.max(np.abs(change))) <= limit:
                    return increment
        raise RuntimeError(self._refusal)

    def _solve_stiffly(self, increment: FloatArray, forces: FloatArray) -> FloatArray:
        """Find the same with the Jacobian of every sweep, and shorter changes where they help."""
        with np.errstate(over="ignore", invalid="ignore"):  # divergence is refused below
            miss = self.demanded(forces, increment) - increment
            for _ in range(MAX_SWEEPS):
                self._set_up_correction(forces, increment)
                change = self._correction @ miss
                size = float(np.max(np.abs(change)))
                scale = float(np.max(np.abs(increment)))
                if not np.isfinite(size + scale):
                    break
                if size <= RELATIVE_TOLERANCE * scale + ABSOLUTE_TOLERANCE:
                    return increment + change
                for halvings in range(MAX_HALVINGS):
                    new = increment + 0.5**halvings * change
                    new_miss = self.demanded(forces, new) - new
                    if np.max(np.abs(new_miss)) <= np.max(np.abs(miss)):
                        break
                increment, miss = new, new_miss
        raise RuntimeError(self._refusal)

    @property
    def _refusal(self) -> str:
        return (
            f"track: the state-dependent forces did not converge in {MAX_SWEEPS} sweeps over a "
            f"step of {self.step_size:.3g} s; use a shorter step"
        )
