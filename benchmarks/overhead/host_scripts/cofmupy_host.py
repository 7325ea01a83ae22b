"""Runs the job in CoFmuPy, with its Jacobi algorithm."""

from time import perf_counter

from cofmupy import Coordinator
from job import Job, report

job = Job.read()
left, right = job.partners
other = {left: right, right: left}
coordinator = Coordinator()
# It starts with inputs of zero; the right ones are given like parameters.
coordinator.start(
    {
        "fmus": [
            {
                "id": name,
                "name": name,
                "path": job.fmu,
                "initialization": {**values, "u": job.partners[other[name]]["start"]},
            }
            for name, values in job.partners.items()
        ],
        "connections": [
            {
                "source": {"id": name, "variable": "y"},
                "target": {"id": other[name], "variable": "u"},
            }
            for name in job.partners
        ],
        "cosim_method": "jacobi",
        "iterative": False,
    }
)
began = perf_counter()
for _ in range(job.steps):
    coordinator.do_step(job.step_size)
seconds = perf_counter() - began
report(seconds, [coordinator.get_variable((name, "y"))[0] for name in job.partners])
