"""Runs the job in CoFmuPy, with its Jacobi algorithm."""

from cofmupy import Coordinator
from job import Host, Job, run


class CoFmuPy(Host):
    """A coordinator of CoFmuPy."""

    def __init__(self, job: Job) -> None:
        self.watched = [tuple(end) for end in job.watched]
        self.step_size = job.step_size
        self.coordinator = Coordinator()
        self.coordinator.start(
            {
                "fmus": [
                    {"id": name, "name": name, "path": path, "initialization": start(job, name)}
                    for name, path in job.fmus.items()
                ],
                "connections": [
                    {
                        "source": {"id": source, "variable": output},
                        "target": {"id": target, "variable": variable},
                    }
                    for source, output, target, variable in job.connections
                ],
                "cosim_method": "jacobi",
                "iterative": False,
            }
        )

    def step(self, count: int) -> None:
        """Take so many macro steps."""
        for _ in range(count):
            self.coordinator.do_step(self.step_size)

    def read(self) -> list[float]:
        """Return what is watched."""
        return [float(self.coordinator.get_variable(end)[0]) for end in self.watched]


def start(job: Job, name: str) -> dict[str, float]:
    """Return parameters and inputs; it starts with inputs of zero where none are given."""
    return {**job.parameters.get(name, {}), **job.inputs.get(name, {})}


job = Job.read()
run(job, CoFmuPy(job))
