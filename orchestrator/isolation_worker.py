"""The process in which an isolated FMU runs: carries out requests until there are no more."""

import os
import signal
import sys
from collections.abc import Callable
from math import isnan

import numpy as np

from .errors import OrchestratorError, ParticipantError
from .fmu import FmuParticipant
from .frames import (
    Operation,
    Report,
    experiment,
    number,
    read_frame,
    sized_number,
    step_times,
    write_frame,
    write_report,
)
from .isolation_setup import IsolationSetup
from .participant import OK, Status, StatusKind


class Worker:
    """An FMU, the states saved of it, and what to do with them.

    Parameters
    ----------
    participant : FmuParticipant
        Bound, not yet instantiated.
    inputs, outputs, observed : int
        Numbers of bound variables.
    """

    def __init__(
        self, participant: FmuParticipant, *, inputs: int, outputs: int, observed: int
    ) -> None:
        self.participant = participant
        self._inputs = np.zeros(inputs)
        self._outputs = np.zeros(outputs)
        self._observed = np.zeros(observed)
        self._derivatives = np.zeros((outputs, inputs))
        self._states: dict[int, object] = {}
        self._payload = b""

    def carry_out(self, request: bytes) -> Report:
        """Do what a request says, up to the first operation that fails."""
        place, self._payload = 0, b""
        try:
            while place < len(request):
                operation = Operation(request[place])
                status, place = self._do(operation, request, place + 1)
                if status is not OK:
                    return Report(status, messages=tuple(self.participant.messages))
        except ParticipantError as error:
            status = Status(StatusKind.FATAL, error.failure)
            return Report(status, messages=error.messages, raises=True)
        return Report(OK, self._payload)

    def _do(self, operation: Operation, data: bytes, place: int) -> tuple[Status, int]:
        participant = self.participant
        if operation is Operation.SET_INPUTS:
            end = place + self._inputs.nbytes
            self._inputs[:] = np.frombuffer(data[place:end])
            return participant.set_inputs(self._inputs), end
        if operation is Operation.STEP:
            status = participant.step(*step_times.unpack_from(data, place))
            return self._read_outputs(status), place + step_times.size
        if operation is Operation.GET_OUTPUTS:
            return self._read_outputs(OK), place
        if operation is Operation.GET_OBSERVED:
            status = participant.get_observed(self._observed)
            self._payload = self._observed.tobytes()
            return status, place
        if operation is Operation.GET_DERIVATIVES:
            status = participant.directional_derivatives(self._derivatives)
            self._payload = self._derivatives.tobytes()
            return status, place
        return OK, self._do_without_status(operation, data, place)

    def _do_without_status(self, operation: Operation, data: bytes, place: int) -> int:
        participant = self.participant
        if operation is Operation.ENTER:
            start, stop, tolerance = experiment.unpack_from(data, place)
            participant.enter_initialisation(
                start_time=start, stop_time=stop, tolerance=None if isnan(tolerance) else tolerance
            )
            return place + experiment.size
        if operation is Operation.EXIT:
            participant.exit_initialisation()
            return place
        if operation is Operation.TERMINATE:
            participant.terminate()
            return place
        return self._handle_state(operation, data, place)

    def _handle_state(self, operation: Operation, data: bytes, place: int) -> int:
        participant, states = self.participant, self._states
        (state,) = number.unpack_from(data, place)
        if operation is Operation.RESTORE:
            participant.restore(states[state])
        elif operation is Operation.SAVE:
            self._release(state)
            states[state] = participant.save()
        elif operation is Operation.RELEASE:
            self._release(state)
        elif operation is Operation.SERIALISE:
            self._payload = participant.serialise(states[state])
        else:
            size: int = sized_number.unpack_from(data, place)[1]
            start = place + sized_number.size
            states[state] = participant.deserialise(data[start : start + size])
            return start + size
        return place + number.size

    def _release(self, number_of_state: int) -> None:
        state = self._states.pop(number_of_state, None)
        if state is not None:
            self.participant.release(state)

    def _read_outputs(self, status: Status) -> Status:
        if status is OK:
            status = self.participant.get_outputs(self._outputs)
            self._payload = self._outputs.tobytes()
        return status


def open_worker(setup: bytes) -> tuple[Worker | None, Report]:
    """Instantiate the FMU that `setup` describes, and report on that."""
    told = IsolationSetup.read(setup)
    names = {"inputs": told.inputs, "outputs": told.outputs, "observed": told.observed}
    try:
        participant = FmuParticipant(told.path, name=told.name, start_values=told.start_values)
        participant.bind(**names, input_shape=told.input_shape)
        participant.instantiate()
    except OrchestratorError as error:
        what = error.failure if isinstance(error, ParticipantError) else str(error)
        messages = error.messages if isinstance(error, ParticipantError) else ()
        return None, Report(Status(StatusKind.FATAL, what), messages=messages, raises=True)
    counts = {key: len(value) for key, value in names.items()}
    return Worker(participant, **counts), Report(OK)


def serve(read: Callable[[int], bytes], write: Callable[[memoryview], int]) -> None:
    """Answer frames until they end."""
    setup = read_frame(read)
    if setup is None:
        return
    worker, report = open_worker(setup)
    write_frame(write, [write_report(report)])
    while worker is not None and (request := read_frame(read)) is not None:
        write_frame(write, [write_report(worker.carry_out(request))])
    if worker is not None:
        worker.participant.free()


def main() -> None:
    """Serve the standard streams; what the FMU itself prints goes to the error stream."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the master's business
    source, sink = os.dup(0), os.dup(1)
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.dup2(2, 1)
    serve(lambda size: os.read(source, size), lambda data: os.write(sink, data))
    sys.stderr.flush()
    os._exit(0)  # leaves out the ends of FMUs' libraries: some crash there, as those of pythonfmu


if __name__ == "__main__":
    main()
