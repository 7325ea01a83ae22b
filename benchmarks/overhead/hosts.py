"""The two FMUs in other tools, each run by a small script in the hosts' own environment."""

import json
import subprocess
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from overhead.system import PARTNERS, STEP, Sample

ROOT = Path(__file__).parents[2]
PYTHON = ROOT / ".venv-hosts" / "bin" / "python"
SCRIPTS = Path(__file__).with_name("host_scripts")
NAMES = ("libcosimpy", "ecospy", "cofmupy")
PATIENCE = 120.0
"""Longest run of a host [s]."""


class HostError(Exception):
    """A host could not be run; the message is one line and says what to do."""


@dataclass(frozen=True)
class Host:
    """A tool that co-simulates FMUs.

    Parameters
    ----------
    name : str
        Its Python package.
    """

    name: str

    @cached_property
    def version(self) -> str:
        """Version of the package.

        Raises
        ------
        HostError
            When it is not installed.
        """
        code = f"from importlib.metadata import version; print(version({self.name!r}))"
        if PYTHON.exists():
            done = _run(["-c", code])
            if done.returncode == 0:
                return done.stdout.strip()
        raise HostError("not installed; run `make hosts`")

    def __call__(self, fmu: Path, steps: int) -> Sample:
        """Run so many macro steps.

        Raises
        ------
        HostError
            When it is not installed or fails.
        """
        assert self.version
        job = {"fmu": str(fmu), "steps": steps, "step_size": STEP, "partners": PARTNERS}
        done = _run([str(SCRIPTS / f"{self.name}_host.py"), json.dumps(job)])
        if done.returncode != 0:
            lines = done.stderr.strip().splitlines() or [f"exit code {done.returncode}"]
            raise HostError(f"failed: {lines[-1]}")
        answer = json.loads(done.stdout.splitlines()[-1])
        left, right = answer["final"]
        return Sample(microseconds=1e6 * answer["seconds"] / steps, final=(left, right))


def _run(arguments: list[str]) -> subprocess.CompletedProcess[str]:
    try:
        return subprocess.run(
            [str(PYTHON), *arguments],
            capture_output=True,
            text=True,
            check=False,
            timeout=PATIENCE,
        )
    except subprocess.TimeoutExpired:
        raise HostError(f"gave no answer within {PATIENCE:g} s") from None
