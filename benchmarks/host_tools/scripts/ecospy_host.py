"""Runs the job in Ecos, with its fixed-step algorithm."""

from ecospy import EcosSimulation, EcosSimulationStructure
from ecospy.lib import EcosLib
from job import Host, Job, run


class Ecos(Host):
    """A simulation of Ecos."""

    def __init__(self, job: Job) -> None:
        self.watched = ["::".join(end) for end in job.watched]
        if job.package:
            self.simulation = EcosSimulation(job.step_size, ssp_path=job.package)
            values = "values"  # name of the parameter sets in the package; silently none without
        else:
            self.simulation = EcosSimulation(job.step_size, structure=assemble(job))
            values = "start" if job.parameters else None
        if not self.simulation.init(0, values):
            raise RuntimeError(EcosLib.get_last_error())

    def step(self, count: int) -> None:
        """Take so many macro steps."""
        self.simulation.step(count)

    def read(self) -> list[float]:
        """Return what is watched."""
        return [self.simulation.get_real(name) for name in self.watched]


def assemble(job: Job) -> EcosSimulationStructure:
    """Return the FMUs, their connections and parameters."""
    structure = EcosSimulationStructure()
    for name, path in job.fmus.items():
        structure.add_model(name, path)
    for source, output, target, variable in job.connections:
        structure.make_real_connection(f"{source}::{output}", f"{target}::{variable}")
    if job.parameters:
        values = {
            f"{name}::{key}": value
            for name, parameters in job.parameters.items()
            for key, value in parameters.items()
        }
        structure.add_parameter_set("start", values)
    return structure


job = Job.read()
EcosLib.set_log_level("warn")
run(job, Ecos(job))
