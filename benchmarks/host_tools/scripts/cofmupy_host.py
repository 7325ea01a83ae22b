"""Runs the job in CoFmuPy, with its Jacobi algorithm."""

from cofmupy import Coordinator
from cofmupy.wrappers import FmuXHandler
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


def real_outputs(handler: FmuXHandler) -> list[str]:
    """Return the names of the outputs that are real numbers."""
    return [
        variable.name
        for variable in handler.description.modelVariables
        if variable.causality == "output" and variable.type in {"Real", "Float64"}
    ]


# CoFmuPy 1.0.0 reads every output as a real number, whatever it is.
FmuXHandler.get_output_names = real_outputs

job = Job.read()
run(job, CoFmuPy(job))
