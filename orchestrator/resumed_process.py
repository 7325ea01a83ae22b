"""The process of an isolated FMU, which is started anew once where it crashes."""

import logging

from .frames import Operation, Report, number
from .participant import OK, Status, StatusKind
from .way_back import Journal, deserialising
from .worker_process import WorkerLostError, WorkerProcess

snapshot_interval = 100
"""Steps from one serialised state to the next: so many are repeated after a crash at most."""

logger = logging.getLogger(__name__)


class ResumedProcess:
    """Carries out operations, after a crash from where the process was.

    After a crash the FMU is started anew once, from the last serialised state, and repeats the
    steps since then; a second crash at the same point is the end, and so is a hang. Both answer as
    `StatusKind.FATAL`.

    Parameters
    ----------
    name : str
        Name of the participant, for messages.
    setup : bytes
        What the process needs to open the FMU.
    timeout : float
        Longest time for one answer [s].

    Attributes
    ----------
    time : float or None
        Start of the step under way [s]; None before the first one.
    incidents : list of str
        Crashes that were survived, a sentence each.
    journal : Journal
        The way back.

    Raises
    ------
    WorkerLostError
        When the process does not even start.
    """

    def __init__(self, name: str, setup: bytes, timeout: float) -> None:
        self.time: float | None = None
        self.incidents: list[str] = []
        self.journal = Journal()
        self._name, self._setup, self._timeout = name, setup, timeout
        self._pending = b""
        self._crashed_at: float | None = None
        self._numbers = 0
        self._worker: WorkerProcess | None = self._start()
        self.started = self._worker.started

    @property
    def number(self) -> int | None:
        """Number of the process, while there is one."""
        return None if self._worker is None else self._worker.number

    def initialise(self, operation: bytes) -> Report:
        """Carry out an operation of the initialisation."""
        self.journal.setup += self._pending + operation
        return self.ask(operation, "the initialisation")

    def do_later(self, operation: bytes) -> None:
        """Carry an operation out together with the next one that has an answer."""
        self._pending += operation

    def ask(self, operation: bytes, what: str, *, steps: int = 0) -> Report:
        """Carry out an operation that has an answer, and say so many `steps` come of it."""
        if self._worker is None:
            return Report(Status(StatusKind.FATAL, f"{what} came when its process had ended"))
        request, self._pending = self._pending + operation, b""
        try:
            report = self._worker.ask(request)
        except WorkerLostError as lost:
            report = self._resume(lost, request, what)
        if report.status is not OK:
            if report.status.kind is StatusKind.FATAL and not report.raises:
                self.end()
        elif steps:
            self.journal.go_on(operation, steps=steps)
        self.journal.confirm()
        return report

    def save(self) -> tuple[int, Report]:
        """Save the present state, as bytes too from time to time; return its number."""
        if self.journal.steps >= snapshot_interval:
            return self.save_serialised()
        self._numbers += 1
        self.do_later(bytes([Operation.SAVE]) + number.pack(self._numbers))
        self.journal.keep(self._numbers)
        return self._numbers, Report(OK)

    def save_serialised(self) -> tuple[int, Report]:
        """Save the present state as bytes, too; the way back begins there."""
        self._numbers += 1
        report = self.ask(_saving_serialised(self._numbers), "serialising a state")
        if report.status is OK:
            self.journal.keep_serialised(self._numbers, report.payload, present=True)
        return self._numbers, report

    def restore(self, state: int) -> None:
        """Go back to a saved state, with the next operation that has an answer."""
        self.do_later(bytes([Operation.RESTORE]) + number.pack(state))
        self.journal.go_back(state)

    def release(self, state: int) -> None:
        """Give up a saved state."""
        if self.journal.drop(state):
            self.do_later(bytes([Operation.RELEASE]) + number.pack(state))

    def serialise(self, state: int) -> Report:
        """Ask for the bytes of a saved state, a new process where the old one has ended."""
        what = "serialising a state"
        way = self.journal.way_to_state(state)
        if self._worker is not None or way is None:
            return self.ask(bytes([Operation.SERIALISE]) + number.pack(state), what)
        try:
            worker = self._start()
            try:
                started = worker.started
                return (
                    worker.ask(way + _saving_serialised(state)) if started.status is OK else started
                )
            finally:
                worker.end()
        except WorkerLostError as lost:
            return Report(Status(StatusKind.FATAL, f"a new process {lost.reason} in {what}"))

    def deserialise(self, data: bytes) -> tuple[int, Report]:
        """Make a saved state of `data`; return its number."""
        self._numbers += 1
        report = self.ask(deserialising(self._numbers, data), "deserialising a state")
        if report.status is OK:
            self.journal.keep_serialised(self._numbers, data, present=False)
        return self._numbers, report

    def end(self) -> None:
        """End the process; harmless when repeated."""
        worker, self._worker = self._worker, None
        if worker is not None:
            worker.end()

    def _start(self) -> WorkerProcess:
        return WorkerProcess(self._setup, self._timeout)

    def _resume(self, lost: WorkerLostError, request: bytes, what: str) -> Report:
        """Start the process anew and repeat what it takes to repeat `request`, once."""
        self.end()
        reason = f"its process {lost.reason} in {what}"
        way = self.journal.way_to_present()
        if not lost.crashed or way is None or self._crashed_at == self.time:
            return Report(Status(StatusKind.FATAL, reason))
        self._crashed_at = self.time
        where = "before the first step" if self.time is None else f"at t = {self.time:.9g} s"
        try:
            self._worker = worker = self._start()
            if worker.started.status is OK:
                report = worker.ask(way + request)
                incident = (
                    f"{self._name}: {reason} {where}; it was started anew and went on from there, "
                    f"{self.journal.confirmed_steps} steps after its last serialised state."
                )
                self.incidents.append(incident)
                logger.warning("%s", incident)
                return report
        except WorkerLostError as again:
            reason += f", and {again.reason} when that was repeated in a new one"
        self.end()
        return Report(Status(StatusKind.FATAL, reason))


def _saving_serialised(state: int) -> bytes:
    """Return the operations that save the present state under a number and report its bytes."""
    return b"".join(
        bytes([operation]) + number.pack(state)
        for operation in (Operation.SAVE, Operation.SERIALISE)
    )
