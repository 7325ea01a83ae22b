"""Runs the job in libcosim (Open Simulation Platform), with its fixed-step algorithm."""

from job import Host, Job, run
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave


class Libcosim(Host):
    """An execution of libcosim."""

    def __init__(self, job: Job) -> None:
        step = round(job.step_size * 1e9)  # ns
        if job.package:
            self.execution = CosimExecution.from_ssp_file(job.package, step)
        else:
            self.execution = CosimExecution.from_step_size(step)
            self.assemble(job)
        self.observer = CosimObserver.create_last_value()
        self.execution.add_observer(self.observer)
        self.watched = [self.place(*end) for end in job.watched]

    def assemble(self, job: Job) -> None:
        """Add the FMUs, set their parameters and connect them."""
        for name, path in job.fmus.items():
            self.execution.add_local_slave(CosimLocalSlave(path, name))
        for name, values in job.parameters.items():
            for variable, value in values.items():
                assert self.execution.real_initial_value(*self.place(name, variable), value)
        for source, output, target, variable in job.connections:
            ends = (*self.place(source, output), *self.place(target, variable))
            assert self.execution.connect_real_variables(*ends) == 0

    def place(self, component: str, variable: str) -> tuple[int, int]:
        """Return index of a component and reference of a variable."""
        index = self.execution.slave_index_from_instance_name(component)
        variables = self.execution.slave_variables(index)
        return index, {item.name.decode(): item.reference for item in variables}[variable]

    def step(self, count: int) -> None:
        """Take so many macro steps."""
        assert self.execution.step(count)

    def read(self) -> list[float]:
        """Return what is watched."""
        last = self.observer.last_real_values
        return [last(index, [reference])[0] for index, reference in self.watched]


job = Job.read()
log_output_level(CosimLogLevel.ERROR)
run(job, Libcosim(job))
