"""fmpy, in this process: passes all outputs on, then steps all FMUs."""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from tempfile import TemporaryDirectory
from time import perf_counter

import fmpy
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave

from .answer import Answer
from .scripts.job import Job


class FmpyHost:
    """A loop over fmpy's classes; the version of FMI is that of the FMUs."""

    version = fmpy.__version__

    def run(self, job: Job) -> Answer:
        """Run a job, reading what is watched after every step."""
        with ExitStack() as stack:
            slaves = {name: stack.enter_context(_slave(path)) for name, path in job.fmus.items()}
            for name, values in job.parameters.items():
                for variable, value in values.items():
                    slaves[name].write(variable, value)
            for slave in slaves.values():
                slave.fmu.enterInitializationMode()
            for source, output, target, variable in job.connections:
                slaves[target].write(variable, slaves[source].read(output))
            for slave in slaves.values():
                slave.fmu.exitInitializationMode()
            largest = [slaves[name].read(output) for name, output in job.watched]
            began = perf_counter()
            for k in range(job.steps):
                passed = [slaves[source].read(output) for source, output, _, _ in job.connections]
                for (_, _, target, variable), value in zip(job.connections, passed, strict=True):
                    slaves[target].write(variable, value)
                for slave in slaves.values():
                    slave.fmu.doStep(k * job.step_size, job.step_size)
                final = [slaves[name].read(output) for name, output in job.watched]
                largest = [max(pair) for pair in zip(largest, final, strict=True)]
            seconds = perf_counter() - began
        return Answer(seconds=seconds, final=tuple(final), largest=tuple(largest))


class _Slave:
    """An instance whose variables are known by name."""

    def __init__(self, path: str, folder: str) -> None:
        description = fmpy.read_model_description(path)
        self.reference = {v.name: v.valueReference for v in description.modelVariables}
        second = description.fmiVersion.startswith("2")
        self.fmu = (FMU2Slave if second else FMU3Slave)(
            guid=description.guid if second else description.instantiationToken,
            unzipDirectory=folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=description.modelName,
        )
        self.fmu.instantiate()
        if second:
            self.fmu.setupExperiment(startTime=0.0)
        self.getter = self.fmu.getReal if second else self.fmu.getFloat64
        self.setter = self.fmu.setReal if second else self.fmu.setFloat64

    def read(self, name: str) -> float:
        """An output."""
        return float(self.getter([self.reference[name]])[0])

    def write(self, name: str, value: float) -> None:
        """Set an input or a parameter."""
        self.setter([self.reference[name]], [value])


@contextmanager
def _slave(path: str) -> Iterator[_Slave]:
    with TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        fmpy.extract(path, folder)
        slave = _Slave(path, folder)
        try:
            yield slave
        finally:
            slave.fmu.terminate()
            slave.fmu.freeInstance()
