"""Runs the job in Ecos, with its fixed-step algorithm."""

from time import perf_counter

from ecospy import EcosSimulation, EcosSimulationStructure
from ecospy.lib import EcosLib
from job import Job, report

job = Job.read()
EcosLib.set_log_level("warn")
structure = EcosSimulationStructure()
left, right = job.partners
for name in job.partners:
    structure.add_model(name, job.fmu)
structure.make_real_connection(f"{left}::y", f"{right}::u")
structure.make_real_connection(f"{right}::y", f"{left}::u")
parameters = {
    f"{name}::{key}": value
    for name, values in job.partners.items()
    for key, value in values.items()
}
structure.add_parameter_set("start", parameters)
simulation = EcosSimulation(job.step_size, structure=structure)
assert simulation.init(0, "start")
simulation.step(1)
began = perf_counter()
simulation.step(job.steps - 1)
seconds = perf_counter() - began
final = [simulation.get_real(f"{name}::y") for name in job.partners]
report(seconds * job.steps / (job.steps - 1), final)
