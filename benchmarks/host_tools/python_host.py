"""Other tools with a Python interface, each run by a small script in the hosts' own environment."""

import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from .answer import Answer, HostError, run_process
from .scripts.job import Job

ROOT = Path(__file__).parents[2]
PYTHON = ROOT / ".venv-hosts" / "bin" / "python"
SCRIPTS = Path(__file__).with_name("scripts")
NAMES = ("libcosimpy", "ecospy", "cofmupy")
READ_PACKAGES = ("libcosimpy", "ecospy")
"""Those that take a system description (.ssp) as it is."""


@dataclass(frozen=True)
class PythonHost:
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
            When it is not installed, or cannot be loaded.
        """
        if not PYTHON.exists():
            raise HostError("not installed; run `make hosts`", missing=True)
        code = (
            f"from importlib.metadata import version; import {self.name}; "
            f"print(version({self.name!r}))"
        )
        done = run_process([str(PYTHON), "-c", code])
        if done.returncode == 0:
            return done.stdout.splitlines()[-1]
        if "libtbb" in done.stderr:
            remedy = "libtbb.so.12 is missing; install it (on Debian: apt install libtbb12)"
            raise HostError(remedy, missing=True)
        raise HostError("not installed; run `make hosts`", missing=True)

    def run(self, job: Job) -> Answer:
        """Run a job.

        Raises
        ------
        HostError
            When it is not installed or fails.
        """
        assert self.version
        script = SCRIPTS / f"{self.name}_host.py"
        done = run_process([str(PYTHON), str(script), json.dumps(job._asdict())])
        return Answer.of(done)
