"""The passage with contact on the track's side as a job for any host."""

from pathlib import Path

import fmpy

from fmu_src.building import FmuPaths
from railcosim.passage_package import describe_passage
from railcosim.scenario_file import read_scenario

from .scripts.job import Job

STEP = 1e-4
"""Size of a macro step [s], without iteration."""


def passage_job(fmus: FmuPaths, *, package: Path | None = None) -> Job:
    """Return the passage of the paper's bogie with its flat.

    Parameters
    ----------
    fmus : FmuPaths
        TrackContact and Masses of the default size; their start values are this passage but for
        the speed at which the rail under the wheels starts.
    package : Path, optional
        The system description to be read by the host, with these FMUs.
    """
    description = describe_passage(read_scenario(None, ()), fmus, "track")
    paths = {"vehicle": str(fmus.vehicle), "track": str(fmus.track)}
    return Job(
        fmus=paths,
        connections=[(*link.start, *link.end) for link in description.links],
        step_size=STEP,
        steps=round(description.stop_time / STEP),
        watched=[("track", "wheel[1].contact_force")],
        parameters={"track": {"initial_speed": _start(paths["vehicle"], "speed")}},
        inputs={name: _inputs(path) for name, path in paths.items()},
        package=str(package) if package else "",
        each_step=True,
    )


def _start(fmu: str, name: str) -> float:
    variables = fmpy.read_model_description(fmu).modelVariables
    return next(float(variable.start) for variable in variables if variable.name == name)


def _inputs(fmu: str) -> dict[str, float]:
    return {
        variable.name: float(variable.start)
        for variable in fmpy.read_model_description(fmu).modelVariables
        if variable.causality == "input"
    }
