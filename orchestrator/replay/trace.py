"""What every participant was told and answered in the last attempt of a run."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import cast

from ..decision import Candidate, Decision
from ..participant import OK, InputShape, Participant, Status, Variable, Vector
from ..step_control import StepController
from ..step_log import StepLog


@dataclass(frozen=True, slots=True, kw_only=True)
class TraceRow:
    """A step of one participant.

    Attributes
    ----------
    iteration : int
        Which step of this participant within the attempt, from 1.
    participant : str
        Its name.
    time, step_size : float
        Start and size of the step [s].
    inputs, outputs : mapping of str to float
        Inputs set before and outputs read after it; none where it failed.
    status : str
        How it ended.
    """

    iteration: int
    participant: str
    time: float
    step_size: float
    inputs: Mapping[str, float]
    outputs: Mapping[str, float]
    status: str


class Trace:
    """Observer that keeps the steps since the last decision of the master.

    Parameters
    ----------
    observed : sequence of str
        What to observe, as the run did.

    Attributes
    ----------
    rows : list of TraceRow
        Steps of the last attempt, in order.
    """

    def __init__(self, observed: Sequence[str]) -> None:
        self.rows: list[TraceRow] = []
        self._observed = tuple(observed)
        self._over = False

    def choose(self, _available: Mapping[str, Variable], /) -> Sequence[str]:
        """Return what the run observed."""
        return self._observed

    def start(self, _variables: Mapping[str, Variable], _log: StepLog, /) -> None:
        """Nothing is learned from the names."""

    def accepted(self, _time: float, _values: Vector, /) -> None:
        """Take what follows for a new attempt."""
        self.end_attempt()

    def finished(self) -> None:
        """Nothing is left to do."""

    def end_attempt(self) -> None:
        """Take what follows for a new attempt."""
        self._over = True

    def add(self, row: TraceRow) -> None:
        """Keep a step, numbered anew."""
        if self._over:
            self.rows.clear()
            self._over = False
        earlier = sum(other.participant == row.participant for other in self.rows)
        self.rows.append(replace(row, iteration=earlier + 1))

    def answer(self, participant: str, outputs: Mapping[str, float]) -> None:
        """Complete the last step by its outputs, if it is one of that participant."""
        if self.rows and not self._over and self.rows[-1].participant == participant:
            self.rows[-1] = replace(self.rows[-1], outputs=outputs)


class TracedParticipant:
    """A participant whose steps leave a trace; everything else passes through.

    Parameters
    ----------
    inner : Participant
        Who does the work.
    trace : Trace
        Where its steps go.
    """

    def __init__(self, inner: Participant, trace: Trace) -> None:
        self._inner, self._trace = inner, trace
        self._inputs: tuple[str, ...] = ()
        self._outputs: tuple[str, ...] = ()
        self._values: list[float] = []

    def __getattr__(self, name: str) -> object:
        return getattr(self._inner, name)

    def bind(
        self,
        *,
        inputs: Sequence[str],
        outputs: Sequence[str],
        observed: Sequence[str],
        input_shape: InputShape,
    ) -> None:
        """Learn the names."""
        self._inputs, self._outputs = tuple(inputs), tuple(outputs)
        self._inner.bind(inputs=inputs, outputs=outputs, observed=observed, input_shape=input_shape)

    def set_inputs(self, values: Vector) -> Status:
        """Remember the inputs of the next step."""
        self._values = values.tolist()
        return self._inner.set_inputs(values)

    def step(self, time: float, step_size: float) -> Status:
        """Step and leave a row, also when it is the last thing that happens."""
        status = self._inner.step(time, step_size)
        self._trace.add(
            TraceRow(
                iteration=0,
                participant=self._inner.name,
                time=time,
                step_size=step_size,
                inputs=dict(zip(self._inputs, self._values, strict=True)),
                outputs={},
                status="ok" if status is OK else status.message,
            )
        )
        return status

    def get_outputs(self, out: Vector) -> Status:
        """Read the outputs into the row of the last step too."""
        status = self._inner.get_outputs(out)
        if status is OK:
            self._trace.answer(
                self._inner.name, dict(zip(self._outputs, out.tolist(), strict=True))
            )
        return status


class TracedControl:
    """A step controller whose decisions end an attempt for the trace."""

    def __init__(self, inner: StepController, trace: Trace) -> None:
        self._inner, self._trace = inner, trace

    def __getattr__(self, name: str) -> object:
        return getattr(self._inner, name)

    def decide(self, candidate: Candidate) -> Decision:
        """Let the other one decide."""
        self._trace.end_attempt()
        return self._inner.decide(candidate)


def traced_participant(inner: Participant, trace: Trace) -> Participant:
    """Return a participant that leaves a trace."""
    return cast("Participant", TracedParticipant(inner, trace))


def traced_control(inner: StepController, trace: Trace) -> StepController:
    """Return a step controller that ends attempts for a trace."""
    return cast("StepController", TracedControl(inner, trace))
