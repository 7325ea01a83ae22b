"""An FMU in a process of its own: it may crash or hang without taking the run with it."""

from collections.abc import Mapping, Sequence
from math import nan
from pathlib import Path

import numpy as np

from .errors import ParticipantError, SettingsError
from .exchanged_values import ExchangedValues
from .fmu import DescribedFmu, FmuParticipant, StartValue
from .frames import Operation, Report, experiment, step_times
from .isolation_setup import IsolationSetup
from .participant import OK, InputShape, Matrix, Status, Vector
from .resumed_process import ResumedProcess, snapshot_interval
from .worker_process import WorkerLostError

DEFAULT_TIMEOUT = 60.0
"""Longest answer to one call, start-up of the process included [s]."""


class IsolatedParticipant(DescribedFmu):
    """Participant that drives an FMU in a process of its own.

    What has no answer (inputs, saving, going back) is sent together with the next call that has
    one: a step and its outputs cost one exchange of messages. States stay in that process and are
    known here by number.

    One crash at a point is survived, see `ResumedProcess`; a hang is not.

    Parameters
    ----------
    path : str or pathlib.Path
        The FMU.
    name : str, optional
        Name in the system; the model name by default.
    start_values : mapping of str to float, int, bool or str, optional
        Values to set before the initialisation.
    timeout : float
        Longest time for one answer [s].

    Attributes
    ----------
    incidents : list of str
        Crashes that were survived, a sentence each.

    Raises
    ------
    FmuError
        When the file or a start value is not usable.
    SettingsError
        When the time-out is not positive.
    """

    def __init__(
        self,
        path: str | Path,
        *,
        name: str | None = None,
        start_values: Mapping[str, StartValue] | None = None,
        timeout: float = DEFAULT_TIMEOUT,
    ) -> None:
        if not timeout > 0.0:
            raise SettingsError(f"timeout = {timeout} s must be positive.")
        super().__init__(path)
        self._timeout = timeout
        # Never instantiated: it knows the file and decides on the shape of the inputs.
        self._described = FmuParticipant(path, name=name, start_values=start_values)
        self.name = self._described.name
        self.incidents: list[str] = []
        self._setup = IsolationSetup(
            path=str(Path(path).absolute()), name=self.name, start_values=dict(start_values or {})
        )
        self._exchanged = ExchangedValues(())
        self._process: ResumedProcess | None = None
        self._step_size: float | None = None
        self._messages: tuple[str, ...] = ()

    @property
    def input_shape(self) -> InputShape:
        """How its inputs run over a step."""
        return self._described.input_shape

    @property
    def messages(self) -> Sequence[str]:
        """What it logged last before it failed, oldest first."""
        return self._messages

    @property
    def process(self) -> int | None:
        """Number of the process, while there is one."""
        return None if self._process is None else self._process.number

    def bind(
        self,
        *,
        inputs: Sequence[str],
        outputs: Sequence[str],
        observed: Sequence[str],
        input_shape: InputShape,
    ) -> None:
        """Fix the variables exchanged; take inputs as straight lines if it can and should."""
        self._setup = self._setup.bound(
            inputs=inputs, outputs=outputs, observed=observed, input_shape=input_shape
        )
        self._described.bind(
            inputs=inputs, outputs=outputs, observed=observed, input_shape=input_shape
        )

    def instantiate(self) -> None:
        """Start the process and create the instance in it."""
        self.free()
        self._messages, self._step_size = (), None
        self._process = None
        self._exchanged = ExchangedValues(self._setup.inputs)
        try:
            self._process = ResumedProcess(self.name, self._setup.write(), self._timeout)
        except WorkerLostError as lost:
            raise self._error(f"its process {lost.reason} when it was instantiated") from lost
        self._process.incidents = self.incidents
        self._require(self._process.started)

    def enter_initialisation(
        self, *, start_time: float, stop_time: float, tolerance: float | None
    ) -> None:
        """Set up the experiment [s] and enter the initialisation mode."""
        values = (start_time, stop_time, nan if tolerance is None else tolerance)
        self._initialise(bytes([Operation.ENTER]) + experiment.pack(*values))

    def exit_initialisation(self) -> None:
        """Leave the initialisation mode, and keep the state reached if it can be serialised."""
        self._initialise(bytes([Operation.EXIT]))
        if self.can_save_state and self.can_serialise_state:
            self.release(self._new_state(self._live.save_serialised()))

    def set_inputs(self, values: Vector) -> Status:
        """Set the bound inputs, shape (n_inputs,), with the next call that has an answer."""
        operation = self._exchanged.give(values)
        self._live.do_later(operation)
        self._live.journal.go_on(operation)
        return OK

    def get_outputs(self, out: Vector) -> Status:
        """Write the bound outputs to `out`, shape (n_outputs,)."""
        if self._exchanged.outputs is None:
            report = self._read(Operation.GET_OUTPUTS, "outputs")
            if report.status is not OK:
                return report.status
            self._exchanged.take(report)
        out[:] = self._exchanged.outputs
        return OK

    def get_observed(self, out: Vector) -> Status:
        """Write the observed values to `out`, shape (n_observed,)."""
        report = self._read(Operation.GET_OBSERVED, "observed values")
        if report.status is OK:
            out[:] = np.frombuffer(report.payload)
        return report.status

    def directional_derivatives(self, out: Matrix) -> Status:
        """Write what each output gains with each input, shape (n_outputs, n_inputs)."""
        report = self._read(Operation.GET_DERIVATIVES, "directional derivatives")
        if report.status is OK:
            out[:] = np.frombuffer(report.payload).reshape(out.shape)
        return report.status

    def step(self, time: float, step_size: float) -> Status:
        """Advance from `time` [s] by `step_size` [s]."""
        process = self._live
        process.time, self._step_size = time, step_size
        if process.journal.steps >= 2 * snapshot_interval:
            self.release(self._new_state(self._live.save_serialised()))  # nobody else saves states
        operation = bytes([Operation.STEP]) + step_times.pack(time, step_size)
        report = self._noted(process.ask(operation, "the step", steps=1))
        if report.status is OK:
            self._exchanged.take(report)
        return report.status

    def save(self) -> object:
        """Return a new handle of the complete present state."""
        return self._new_state(self._live.save())

    def restore(self, state: object) -> None:
        """Go back to `state`, with the next call that has an answer."""
        assert isinstance(state, int)
        self._live.restore(state)
        self._exchanged.forget()

    def release(self, state: object) -> None:
        """Give up `state`."""
        assert isinstance(state, int)
        self._live.release(state)

    def serialise(self, state: object) -> bytes:
        """Return `state` as bytes, also after the process has ended."""
        assert isinstance(state, int)
        return self._require(self._live.serialise(state))

    def deserialise(self, data: bytes) -> object:
        """Return a new handle of the state in `data`."""
        return self._new_state(self._live.deserialise(data))

    def terminate(self) -> None:
        """End the simulation in order."""
        self._require(self._live.ask(bytes([Operation.TERMINATE]), "terminating"))

    def free(self) -> None:
        """End the process; harmless when repeated."""
        if self._process is not None:
            self._process.end()

    @property
    def _live(self) -> ResumedProcess:
        assert self._process is not None, "instantiate comes first"
        return self._process

    def _initialise(self, operation: bytes) -> None:
        self._require(self._live.initialise(operation))
        self._exchanged.forget()

    def _read(self, operation: Operation, what: str) -> Report:
        return self._noted(self._live.ask(bytes([operation]), f"reading its {what}"))

    def _new_state(self, saved: tuple[int, Report]) -> int:
        state, report = saved
        self._require(report)
        return state

    def _noted(self, report: Report) -> Report:
        if report.status is not OK:
            self._messages = report.messages
        return report

    def _require(self, report: Report) -> bytes:
        if self._noted(report).status is not OK:
            raise self._error(report.status.message)
        return report.payload

    def _error(self, failure: str) -> ParticipantError:
        time = None if self._process is None else self._process.time
        return ParticipantError(
            participant=self.name,
            failure=failure,
            time=time,
            step_size=self._step_size,
            inputs=None if time is None else self._exchanged.named_inputs(),
            messages=self._messages,
        )
