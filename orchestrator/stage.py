"""A participant in its place in the system: its slices of the exchanged values and its state."""

from collections.abc import Mapping, Sequence
from math import isfinite

import numpy as np
from numpy.typing import NDArray

from .decision import Cause, Failure
from .errors import ParticipantError
from .participant import OK, Matrix, Participant, Status, StatusKind, Vector
from .units import Linear, identity

Indices = NDArray[np.intp]

causes = {
    StatusKind.DISCARD: Cause.DISCARD,
    StatusKind.EARLY: Cause.DISCARD,
    StatusKind.ERROR: Cause.INVALID,
}


class Stage:
    """Steps one participant, from its saved state if it has been stepped since.

    Parameters
    ----------
    participant : Participant
        The partner.
    inputs, outputs : numpy.ndarray, shape (n_inputs,) and (n_outputs,)
        Views of the exchanged values.
    observed : numpy.ndarray, shape (n_observed,)
        View of the observed values.
    input_names, output_names, observed_names : sequence of str
        Names of their variables.
    conversions : sequence of Linear
        How each input is made of the value in `inputs`, which is in the unit of its source.
    """

    def __init__(
        self,
        participant: Participant,
        *,
        inputs: Vector,
        outputs: Vector,
        observed: Vector,
        input_names: Sequence[str],
        output_names: Sequence[str],
        observed_names: Sequence[str],
        conversions: Sequence[Linear],
    ) -> None:
        self.participant = participant
        self.inputs = inputs
        self.outputs = outputs
        self.observed = observed
        self.input_names = tuple(input_names)
        self.output_names = tuple(output_names)
        self.observed_names = tuple(observed_names)
        self._zeros = np.zeros_like(outputs)
        self._outputs_dot = outputs.dot
        self._state: object = None
        self._moved = False
        # Nothing is added to the calls of a participant that takes all its inputs as they are.
        self._converts = any(conversion != identity for conversion in conversions)
        self._factors = np.array([conversion.factor for conversion in conversions])
        self._offsets = np.array([conversion.offset for conversion in conversions])
        self._set_inputs = self._set_converted if self._converts else participant.set_inputs
        self._get_outputs = participant.get_outputs
        self._step = participant.step
        self._restore = participant.restore

    def save(self) -> None:
        """Save the present state and give up the one saved before."""
        before = self._state
        self._state = self.participant.save()
        self._moved = False
        if before is not None:
            self.participant.release(before)

    def adopt(self, state: object) -> None:
        """Go to `state` and keep it in place of the one saved before."""
        self._restore(state)
        before, self._state = self._state, state
        self._moved = False
        if before is not None:
            self.participant.release(before)

    def release(self) -> None:
        """Give up the saved state."""
        state, self._state = self._state, None
        if state is not None:
            self.participant.release(state)

    def go_back(self) -> None:
        """Restore the saved state now."""
        self._restore(self._state)
        self._moved = False

    def serialise(self) -> bytes:
        """Return the saved state as bytes."""
        return self.participant.serialise(self._state)

    def resume(self, data: bytes) -> None:
        """Make the state in `data` the saved and the present one."""
        self.release()
        self._state = self.participant.deserialise(data)
        self.go_back()

    def step(self, time: float, step_size: float) -> Failure | None:
        """Set the inputs, step from the saved state and read the outputs.

        Raises
        ------
        ParticipantError
            When the participant died.
        """
        if self._moved and self._state is not None:
            self._restore(self._state)
        self._moved = True
        status = self._set_inputs(self.inputs)
        if status is OK:
            status = self._step(time, step_size)
            if status is OK:
                status = self._get_outputs(self.outputs)
                # Zero times infinity or NaN is NaN: one product finds any of them.
                if status is OK and isfinite(self._outputs_dot(self._zeros)):
                    return None
        return self._failure(status, time, step_size)

    def exchange(self, wanted: Indices | None = None) -> Failure | None:
        """Set the inputs and read the outputs without a step, as the initialisation does.

        Where `wanted` gives places of outputs, the others need not be finite yet.
        """
        status = self._set_inputs(self.inputs)
        if status is OK:
            status = self._get_outputs(self.outputs)
            outputs = self.outputs if wanted is None else self.outputs[wanted]
            if status is OK and np.isfinite(outputs).all():
                return None
        return self._failure(status, None, None, wanted)

    def directional_derivatives(
        self, declared: Mapping[str, frozenset[str] | None]
    ) -> Matrix | None:
        """Return what each output gains with each input, both as in the flat arrays.

        Zeros of a participant that gives no derivatives but declares no dependence.

        Parameters
        ----------
        declared : mapping of str to frozenset of str or None
            Dependences of its outputs on its inputs; None: not known.

        Returns
        -------
        numpy.ndarray, shape (n_outputs, n_inputs), or None
            None when they are not known.
        """
        participant = self.participant
        if not participant.provides_directional_derivatives:
            return (
                None
                if self.passes_on(declared)
                else np.zeros((self.outputs.size, self.inputs.size))
            )
        out = np.full((self.outputs.size, self.inputs.size), np.nan)
        status = participant.directional_derivatives(out)
        if status.kind is StatusKind.FATAL:
            raise self.error(status.message)
        return out * self._factors if status is OK else None

    def passes_on(self, declared: Mapping[str, frozenset[str] | None]) -> bool:
        """Return whether any output may depend on any input, as far as is `declared`."""
        inputs = set(self.input_names)
        known = [declared[name] for name in self.output_names]
        return any(names is None or names & inputs for names in known) if inputs else False

    def converted_inputs(self) -> Vector:
        """Return the inputs in the units of the participant, shape (n_inputs,)."""
        return self._factors * self.inputs + self._offsets if self._converts else self.inputs

    def read_outputs(self) -> None:
        """Read the outputs as they are."""
        self._require(self._get_outputs(self.outputs))

    def read_observed(self, time: float, step_size: float | None = None) -> Failure | None:
        """Read the observed values at the end of a step from `time`, or at `time` itself [s]."""
        status = self.participant.get_observed(self.observed)
        if status is OK and np.isfinite(self.observed).all():
            return None
        return self._failure(status, time, step_size)

    def error(
        self, what: str, time: float | None = None, step_size: float | None = None
    ) -> ParticipantError:
        """Return the error that says what happened, when and with which inputs."""
        inputs = dict(zip(self.input_names, self.converted_inputs().tolist(), strict=True))
        return ParticipantError(
            participant=self.participant.name,
            failure=what,
            time=time,
            step_size=step_size,
            inputs=inputs if step_size is not None else None,
            messages=self.participant.messages,
        )

    def _set_converted(self, values: Vector) -> Status:
        return self.participant.set_inputs(self._factors * values + self._offsets)

    def _require(self, status: Status) -> None:
        if status is not OK:
            raise self.error(status.message)

    def _failure(
        self,
        status: Status,
        time: float | None,
        step_size: float | None,
        wanted: Indices | None = None,
    ) -> Failure:
        if status is OK:
            names = (*self.output_names, *self.observed_names)
            values = np.concatenate([self.outputs, self.observed])
            if wanted is not None:
                names, values = tuple(names[place] for place in wanted), values[wanted]
            name = names[int(np.argmin(np.isfinite(values)))]
            error = self.error(f"its value of {name} is not finite", time, step_size)
            return Failure(Cause.INVALID, str(error))
        error = self.error(status.message, time, step_size)
        if status.kind is StatusKind.FATAL:
            raise error
        return Failure(
            causes[status.kind],
            str(error),
            last_successful_time=status.last_successful_time,
            ends_early=status.kind is StatusKind.EARLY,
            participant_error=error if status.kind is StatusKind.ERROR else None,
        )
