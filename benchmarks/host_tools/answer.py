"""What came out of a host that ran in a process of its own."""

import json
import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

PATIENCE = 120.0
"""Longest run of a host [s]."""


class HostError(Exception):
    """A host could not be run; the message is one line and says what to do.

    Parameters
    ----------
    message : str
        The line.
    missing : bool
        Whether it is only not there.
    """

    def __init__(self, message: str, *, missing: bool = False) -> None:
        super().__init__(message)
        self.missing = missing


@dataclass(frozen=True, slots=True, kw_only=True)
class Answer:
    """A run of a job.

    Attributes
    ----------
    seconds : float
        Wall time of all steps, without setting up and cleaning up.
    final, largest : tuple of float
        Last and largest values of what was watched; without ``each_step``, the largest is that
        of the first step.
    """

    seconds: float
    final: tuple[float, ...]
    largest: tuple[float, ...]

    @classmethod
    def of(cls, done: subprocess.CompletedProcess[str]) -> "Answer":
        """Read the last line that a host printed.

        Raises
        ------
        HostError
            When it failed.
        """
        if done.returncode != 0:
            lines = done.stderr.strip().splitlines() or [f"exit code {done.returncode}"]
            raise HostError(f"failed: {lines[-1]}")
        told = json.loads(done.stdout.splitlines()[-1])
        return cls(
            seconds=told["seconds"], final=tuple(told["final"]), largest=tuple(told["largest"])
        )


def run_process(
    command: Sequence[str], environment: Mapping[str, str] | None = None
) -> subprocess.CompletedProcess[str]:
    """Run a host, with the present environment if none is given.

    Raises
    ------
    HostError
        When it gives no answer.
    """
    try:
        return subprocess.run(
            command,
            capture_output=True,
            text=True,
            check=False,
            timeout=PATIENCE,
            env=None if environment is None else dict(environment),
        )
    except subprocess.TimeoutExpired:
        raise HostError(f"failed: no answer within {PATIENCE:g} s") from None
