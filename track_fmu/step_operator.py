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
from .component_motion import ComponentMotion, StepLoads
from .components import ActiveComponents
from .contact_point import RailPoint
from .eigensolver import ComplexArray
from .exponential_step import ExponentialStep
from .increment_equation import IncrementEquation
from .reduction import ReducedTrack
from .track_state import TrackState


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
    increments : IncrementEquation
        Of the force increments of the active components at its end.
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
        self._contact: ComplexArray = np.array([w.shape @ track.shape[w.rows] for w in wheels])
        self._end = exponential.end
        self._contact_end = exponential.end if linear else exponential.start + exponential.end
        load = state.load if linear else self._increment_load(state, track)
        self._free: ComplexArray = exponential.decay * state.modal + exponential.start * load
        residual = np.array([track.flexibility[:, w.rows] @ w.shape for w in wheels]).T
        self._set_up_contacts(track, wheels, residual)
        loads = StepLoads(
            self._free, self._contact, self._contact_end, self._end, residual[active.rows]
        )
        self._motion = ComponentMotion(track, active, loads)
        self.increments = IncrementEquation(
            active,
            self._motion,
            step_size=step_size,
            forces=state.force.copy(),
            first=state.increment[active.number],
        )

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
        self.move(state, forces, self.increments.solve(forces))

    def displacement(self, forces: FloatArray, increment: FloatArray) -> FloatArray:
        """Rail displacement under the wheels at the end of the step [m], shape (wheels,)."""
        return np.asarray(
            self._free_contact + self._contact_contact @ forces - self._contact_active @ increment
        )

    def answer_at(self, forces: FloatArray, increment: FloatArray) -> Answer:
        """How increments and rail displacements answer to forces near those given.

        With the tangents at the start of the step where they serve, as in the increments' own
        iteration: those depend on the state alone.
        """
        if not self.increments.stiff:
            return self._answer
        self.increments.linearise(forces, increment)
        return self._make_answer()

    @cached_property
    def _answer(self) -> Answer:
        return self._make_answer()

    def _make_answer(self) -> Answer:
        response, correction = self.increments.response(), self.increments.correction
        return Answer(
            increments=response,
            displacement=self._contact_contact - self._contact_active @ response,
            correction=correction,
            relief=self._contact_active @ correction,
        )

    def move(self, state: TrackState, forces: FloatArray, increment: FloatArray) -> None:
        """Move the state to the end of the step under given contact forces and increments there."""
        contact_load = forces @ self._contact
        increment_load = increment @ self._active.shape
        state.modal[:] = self._free + self._contact_end * contact_load - self._end * increment_load
        state.load[:] = contact_load - increment_load
        state.displacement[:] = self.displacement(forces, increment)
        if self._active.remembers:
            deformation, rate, _ = self._motion.under(forces, increment)
            self._active.remember(state.pads, deformation, rate)
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

    def _set_up_contacts(
        self, track: ReducedTrack, wheels: Sequence[RailPoint], residual: FloatArray
    ) -> None:
        """Displacements under the wheels: free, and per force at the end."""
        active = self._active
        weighted = self._contact * track.weight
        self._free_contact: FloatArray = np.real(weighted @ self._free)
        self._contact_contact: FloatArray = np.real(
            weighted @ (self._contact * self._contact_end).T
        ) + np.array([w.shape @ residual[w.rows] for w in wheels])
        self._contact_active: FloatArray = (
            np.real(weighted @ (active.shape * self._end).T) + residual[active.rows].T
        )
