"""Runs the job in libcosim (Open Simulation Platform), with its fixed-step algorithm."""

from time import perf_counter

from job import Job, report
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

job = Job.read()
log_output_level(CosimLogLevel.ERROR)
execution = CosimExecution.from_step_size(round(job.step_size * 1e9))
slaves = [CosimLocalSlave(job.fmu, name) for name in job.partners]
left, right = places = [execution.add_local_slave(slave) for slave in slaves]
references = {item.name.decode(): item.reference for item in execution.slave_variables(left)}
for place, parameters in zip(places, job.partners.values(), strict=True):
    for name, value in parameters.items():
        assert execution.real_initial_value(place, references[name], value)
execution.connect_real_variables(left, references["y"], right, references["u"])
execution.connect_real_variables(right, references["y"], left, references["u"])
observer = CosimObserver.create_last_value()
execution.add_observer(observer)
assert execution.step(1)
began = perf_counter()
assert execution.step(job.steps - 1)
seconds = perf_counter() - began
final = [observer.last_real_values(place, [references["y"]])[0] for place in places]
report(seconds * job.steps / (job.steps - 1), final)
