"""A child process that answers frames, with a limit on how long that may take."""

import os
import selectors
import signal
import subprocess
import sys
from time import monotonic

from .frames import Report, read_frame, read_report, write_frame

farewell = 5.0
"""Time for a process to end by itself when it is told to [s]."""


thread_limits = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
"""A process each is parallel enough: more threads only get into each other's way."""


class WorkerLostError(Exception):
    """The process gave no answer: it has ended, by itself or by force.

    Parameters
    ----------
    reason : str
        What happened, a clause about ``its process``.
    crashed : bool
        Whether it ended by itself.
    """

    def __init__(self, reason: str, *, crashed: bool) -> None:
        super().__init__(reason)
        self.reason = reason
        self.crashed = crashed


class WorkerProcess:
    """A Python process that runs `isolation_worker`, for systems with POSIX pipes.

    Parameters
    ----------
    setup : bytes
        The first frame.
    timeout : float
        Longest time for one answer [s].
    """

    def __init__(self, setup: bytes, timeout: float) -> None:
        self._timeout = timeout
        self._deadline = 0.0
        paths = os.pathsep.join(path or os.getcwd() for path in sys.path)  # noqa: PTH109 - text
        module = f"{__package__}.isolation_worker"
        self._process = subprocess.Popen(  # noqa: S603 - this interpreter and this package
            [sys.executable, "-m", module],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env={**dict.fromkeys(thread_limits, "1"), **os.environ, "PYTHONPATH": paths},
            process_group=0,  # Ctrl-C reaches all of the terminal's group, at start-up too
        )
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._to, self._from = self._process.stdin.fileno(), self._process.stdout.fileno()
        self._selector = selectors.DefaultSelector()
        self._selector.register(self._from, selectors.EVENT_READ)
        self.started = self.ask(setup)

    @property
    def number(self) -> int:
        """Number of the process."""
        return self._process.pid

    def ask(self, request: bytes) -> Report:
        """Send a request and return the report.

        Raises
        ------
        WorkerLostError
            When the process ends or does not answer in time; it has ended then.
        """
        self._deadline = monotonic() + self._timeout
        try:
            write_frame(lambda data: os.write(self._to, data), [request])
            frame = read_frame(self._read)
            if frame is not None:
                return read_report(frame)
        except TimeoutError:
            self.end(patience=0.0)
            reason = f"gave no answer within {self._timeout:g} s and was ended"
            raise WorkerLostError(reason, crashed=False) from None
        except (BrokenPipeError, ValueError):
            pass
        raise WorkerLostError(self._death(), crashed=True)

    def end(self, patience: float = farewell) -> None:
        """Let the process end, by force after `patience` [s]; harmless when repeated."""
        process = self._process
        if process.stdin is None or process.stdin.closed:
            return
        assert process.stdout is not None
        self._selector.close()
        process.stdin.close()
        try:
            process.wait(patience)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
        process.stdout.close()

    def _read(self, size: int) -> bytes:
        if not self._selector.select(max(0.0, self._deadline - monotonic())):
            raise TimeoutError
        return os.read(self._from, size)

    def _death(self) -> str:
        self.end(patience=1.0)
        code = self._process.returncode
        if code >= 0:
            return f"ended by itself with exit code {code}"
        try:
            name = signal.Signals(-code).name
        except ValueError:
            name = f"signal {-code}"
        return f"was ended by {name}"
