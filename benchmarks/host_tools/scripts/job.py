"""What a host is told to do, and what it tells."""

import json
import sys
from collections.abc import Sequence
from time import perf_counter
from typing import Any, NamedTuple


class Job(NamedTuple):
    """FMUs that are connected and stepped together.

    Attributes
    ----------
    fmus : mapping of str to str
        Paths of the FMUs by component, in the order in which they step.
    connections : sequence of sequence of str
        Component and output, component and input.
    step_size : float
        Size of a macro step [s].
    steps : int
        Number of macro steps.
    watched : sequence of sequence of str
        Components and outputs to tell of.
    parameters : mapping of str to mapping of str to float
        Values set before the initialisation, by component.
    inputs : mapping of str to mapping of str to float
        Values of the inputs at the start, for hosts that pass nothing on before the first step.
    package : str
        System description (.ssp) with these FMUs, connections and parameters, to be read instead
        of them by a host that can.
    each_step : bool
        Whether what is watched is read after every step, not only at the end.
    """

    fmus: dict[str, str]
    connections: Sequence[Sequence[str]]
    step_size: float
    steps: int
    watched: Sequence[Sequence[str]]
    parameters: dict[str, dict[str, float]]
    inputs: dict[str, dict[str, float]]
    package: str = ""
    each_step: bool = False

    @classmethod
    def read(cls) -> "Job":
        """Return the job in the first argument."""
        fields: dict[str, Any] = json.loads(sys.argv[1])
        return cls(**fields)


class Host:
    """An initialised system in a host; a script says how it is stepped and read."""

    def step(self, count: int) -> None:
        """Take so many macro steps."""
        raise NotImplementedError

    def read(self) -> list[float]:
        """Return what is watched."""
        raise NotImplementedError


def run(job: Job, host: Host) -> None:
    """Take all steps of a job, and print how long they took [s], and the last and largest values.

    The first step is not timed: some hosts initialise in it.
    """
    host.step(1)
    largest = host.read()
    began = perf_counter()
    if job.each_step:
        for _ in range(job.steps - 1):
            host.step(1)
            largest = [max(pair) for pair in zip(largest, host.read(), strict=True)]
    else:
        host.step(job.steps - 1)
    seconds = (perf_counter() - began) * job.steps / (job.steps - 1)
    answer = {"seconds": seconds, "final": host.read(), "largest": largest}
    print(json.dumps(answer))
