"""The two integrators in other tools."""

from dataclasses import dataclass
from pathlib import Path

from host_tools.python_host import PythonHost
from host_tools.scripts.job import Job
from overhead.system import PARTNERS, STEP, Sample


@dataclass(frozen=True)
class Hosted:
    """The two integrators in a tool.

    Parameters
    ----------
    host : PythonHost
        The tool.
    """

    host: PythonHost

    def __call__(self, fmu: Path, steps: int) -> Sample:
        """Run so many macro steps.

        Raises
        ------
        HostError
            When it is not installed or fails.
        """
        left, right = PARTNERS
        job = Job(
            fmus=dict.fromkeys(PARTNERS, str(fmu)),
            connections=((left, "y", right, "u"), (right, "y", left, "u")),
            step_size=STEP,
            steps=steps,
            watched=((left, "y"), (right, "y")),
            parameters=PARTNERS,
            inputs={left: {"u": PARTNERS[right]["start"]}, right: {"u": PARTNERS[left]["start"]}},
        )
        answer = self.host.run(job)
        first, second = answer.final
        return Sample(microseconds=1e6 * answer.seconds / steps, final=(first, second))
