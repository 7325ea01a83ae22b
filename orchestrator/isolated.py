"""An FMU in a process of its own: it may crash or hang without taking the run with it."""

import json
import logging
from collections.abc import Mapping, Sequence
from math import nan
from pathlib import Path

import numpy as np

from .errors import ParticipantError, SettingsError
from .fmu import DescribedFmu, FmuParticipant, StartValue
from .frames import Operation, Report, experiment, number, step_times
from .participant import OK, InputShape, Matrix, Status, StatusKind, Vector
from .way_back import Point, deserialising, way_to
from .worker_process import WorkerLostError, WorkerProcess

logger = logging.getLogger(__name__)

DEFAULT_TIMEOUT = 60.0
"""Longest answer to one call, start-up of the process included [s]."""

snapshot_interval = 100
"""Steps from one serialised state to the next: so many are repeated after a crash at most."""


class IsolatedParticipant(DescribedFmu):
    """Participant that drives an FMU in a process of its own.

    What has no answer (inputs, saving, going back) is sent together with the next call that has
    one: a step and its outputs cost one exchange of messages. States stay in that process and are
    known here by number.

    After a crash the FMU is started anew once, from the last serialised state, and repeats the
    steps since then; a second crash at the same point is the end, and so is a hang. Both answer as
    `StatusKind.FATAL`.

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
        self._path, self._timeout = Path(path), timeout
        self._start_values = dict(start_values or {})
        # Never instantiated: it knows the file and decides on the shape of the inputs.
        self._described = FmuParticipant(path, name=name, start_values=start_values)
        self.name = self._described.name
        self.incidents: list[str] = []
        self._bound: tuple[tuple[str, ...], ...] = ((), (), ())
        self._wish: InputShape = "held"
        self._inputs: Vector = np.empty(0)
        self._outputs: Vector = np.empty(0)
        self._outputs_known = False
        self._worker: WorkerProcess | None = None
        self._when: tuple[float | None, float | None] = (None, None)
        self._messages: tuple[str, ...] = ()
        self._pending = self._setup = b""
        # Points are kept from the first serialised state on: without one there is no way back.
        self._point: Point | None = None
        self._confirmed: Point | None = None
        self._states: dict[int, Point | None] = {}
        self._numbers = 0
        self._crashed_at: float | None = None

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
        return None if self._worker is None else self._worker.number

    def bind(
        self,
        *,
        inputs: Sequence[str],
        outputs: Sequence[str],
        observed: Sequence[str],
        input_shape: InputShape,
    ) -> None:
        """Fix the variables exchanged; take inputs as straight lines if it can and should."""
        self._bound = (tuple(inputs), tuple(outputs), tuple(observed))
        self._wish = input_shape
        self._described.bind(
            inputs=inputs, outputs=outputs, observed=observed, input_shape=input_shape
        )

    def instantiate(self) -> None:
        """Start the process and create the instance in it."""
        self.free()
        self._messages, self._when, self._crashed_at = (), (None, None), None
        self._pending = self._setup = b""
        self._point = self._confirmed = None
        self._states.clear()
        self._inputs = np.zeros(len(self._bound[0]))
        self._outputs = np.zeros(len(self._bound[1]))
        try:
            self._worker = self._start()
        except WorkerLostError as lost:
            raise self._error(f"its process {lost.reason} when it was instantiated") from lost
        self._require(self._worker.started)

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
            self.release(self._save_serialised())

    def set_inputs(self, values: Vector) -> Status:
        """Set the bound inputs, shape (n_inputs,), with the next call that has an answer."""
        self._inputs[:] = values
        self._do_later(bytes([Operation.SET_INPUTS]) + self._inputs.tobytes())
        return OK

    def get_outputs(self, out: Vector) -> Status:
        """Write the bound outputs to `out`, shape (n_outputs,)."""
        if not self._outputs_known:
            report = self._ask(bytes([Operation.GET_OUTPUTS]), "reading its outputs")
            if report.status is not OK:
                return report.status
            self._take_outputs(report)
        out[:] = self._outputs
        return OK

    def get_observed(self, out: Vector) -> Status:
        """Write the observed values to `out`, shape (n_observed,)."""
        report = self._ask(bytes([Operation.GET_OBSERVED]), "reading its observed values")
        if report.status is OK:
            out[:] = np.frombuffer(report.payload)
        return report.status

    def directional_derivatives(self, out: Matrix) -> Status:
        """Write what each output gains with each input, shape (n_outputs, n_inputs)."""
        operation = bytes([Operation.GET_DERIVATIVES])
        report = self._ask(operation, "reading its directional derivatives")
        if report.status is OK:
            out[:] = np.frombuffer(report.payload).reshape(out.shape)
        return report.status

    def step(self, time: float, step_size: float) -> Status:
        """Advance from `time` [s] by `step_size` [s]."""
        self._when = (time, step_size)
        if self._point is not None and self._point.steps >= 2 * snapshot_interval:
            self.release(self._save_serialised())  # nobody else saves states
        operation = bytes([Operation.STEP]) + step_times.pack(time, step_size)
        report = self._ask(operation, "the step", leads_on=True)
        if report.status is OK:
            self._take_outputs(report)
        return report.status

    def save(self) -> object:
        """Return a new handle of the complete present state."""
        if self._point is not None and self._point.steps >= snapshot_interval:
            return self._save_serialised()
        self._numbers += 1
        self._pending += bytes([Operation.SAVE]) + number.pack(self._numbers)
        self._states[self._numbers] = self._point
        return self._numbers

    def restore(self, state: object) -> None:
        """Go back to `state`, with the next call that has an answer."""
        assert isinstance(state, int)
        self._pending += bytes([Operation.RESTORE]) + number.pack(state)
        self._point = self._states[state]
        self._outputs_known = False

    def release(self, state: object) -> None:
        """Give up `state`."""
        assert isinstance(state, int)
        if state in self._states:
            del self._states[state]
            self._pending += bytes([Operation.RELEASE]) + number.pack(state)

    def serialise(self, state: object) -> bytes:
        """Return `state` as bytes."""
        assert isinstance(state, int)
        report = self._ask(bytes([Operation.SERIALISE]) + number.pack(state), "serialising a state")
        self._require(report)
        return report.payload

    def deserialise(self, data: bytes) -> object:
        """Return a new handle of the state in `data`."""
        self._numbers += 1
        self._require(self._ask(deserialising(self._numbers, data), "deserialising a state"))
        self._states[self._numbers] = Point(before=None, data=data)
        return self._numbers

    def terminate(self) -> None:
        """End the simulation in order."""
        self._require(self._ask(bytes([Operation.TERMINATE]), "terminating"))

    def free(self) -> None:
        """End the process; harmless when repeated."""
        worker, self._worker = self._worker, None
        if worker is not None:
            worker.end()

    def _start(self) -> WorkerProcess:
        inputs, outputs, observed = self._bound
        setup = {
            "path": str(self._path.absolute()),
            "name": self.name,
            "start_values": self._start_values,
            "inputs": inputs,
            "outputs": outputs,
            "observed": observed,
            "input_shape": self._wish,
        }
        return WorkerProcess(json.dumps(setup).encode(), self._timeout)

    def _initialise(self, operation: bytes) -> None:
        self._setup += self._pending + operation
        self._require(self._ask(operation, "the initialisation"))
        self._outputs_known = False

    def _do_later(self, operation: bytes) -> None:
        self._pending += operation
        self._outputs_known = False
        if self._point is not None:
            before = self._point
            self._point = Point(before=before, operation=operation, steps=before.steps)

    def _take_outputs(self, report: Report) -> None:
        self._outputs[:] = np.frombuffer(report.payload)
        self._outputs_known = True

    def _ask(self, operation: bytes, what: str, *, leads_on: bool = False) -> Report:
        if self._worker is None:
            return Report(Status(StatusKind.FATAL, f"{what} came when its process had ended"))
        request, self._pending = self._pending + operation, b""
        try:
            report = self._worker.ask(request)
        except WorkerLostError as lost:
            report = self._resume(lost, request, what)
        if report.status is not OK:
            self._messages = report.messages
            if report.status.kind is StatusKind.FATAL and not report.raises:
                self.free()
        elif leads_on and self._point is not None:
            before = self._point
            self._point = Point(before=before, operation=operation, steps=before.steps + 1)
        self._confirmed = self._point
        return report

    def _resume(self, lost: WorkerLostError, request: bytes, what: str) -> Report:
        """Start the process anew and repeat what it takes to repeat `request`, once."""
        self.free()
        time, reason = self._when[0], f"its process {lost.reason} in {what}"
        end = Report(Status(StatusKind.FATAL, reason))
        confirmed = self._confirmed
        if not lost.crashed or confirmed is None or self._crashed_at == time:
            return end
        self._crashed_at = time
        where = "before the first step" if time is None else f"at t = {time:.9g} s"
        try:
            self._worker = worker = self._start()
            if worker.started.status is OK:
                way = self._setup
                for state, point in self._states.items():
                    if point is not None:
                        way += way_to(point) + bytes([Operation.SAVE]) + number.pack(state)
                report = worker.ask(way + way_to(confirmed) + request)
                incident = (
                    f"{self.name}: {reason} {where}; it was started anew and went on from there, "
                    f"{confirmed.steps} steps after its last serialised state."
                )
                self.incidents.append(incident)
                logger.warning("%s", incident)
                return report
        except WorkerLostError as again:
            reason += f", and {again.reason} when that was repeated in a new one"
        self.free()
        return Report(Status(StatusKind.FATAL, reason))

    def _save_serialised(self) -> object:
        self._numbers += 1
        state = self._numbers
        operation = bytes([Operation.SAVE]) + number.pack(state)
        operation += bytes([Operation.SERIALISE]) + number.pack(state)
        report = self._ask(operation, "serialising a state")
        self._require(report)
        self._point = self._confirmed = self._states[state] = Point(
            before=None, data=report.payload
        )
        return state

    def _require(self, report: Report) -> None:
        if report.status is not OK:
            self._messages = report.messages
            raise self._error(report.status.message)

    def _error(self, failure: str) -> ParticipantError:
        time, step_size = self._when
        inputs = dict(zip(self._bound[0], self._inputs.tolist(), strict=True))
        return ParticipantError(
            participant=self.name,
            failure=failure,
            time=time,
            step_size=step_size,
            inputs=inputs if time is not None else None,
            messages=self._messages,
        )
