"""One passage: from a scenario through two FMUs and the master to a result."""

from __future__ import annotations

from typing import TYPE_CHECKING

import fmpy
from threadpoolctl import threadpool_limits

import orchestrator
from orchestrator import Master
from orchestrator.replay import ReplayCase

from .builds import build_for
from .coupled_system import (
    fmu_sources,
    join,
    located_events,
    master_settings,
    with_steps_for,
)
from .errors import InputError, RunError
from .evidence import keeping_evidence
from .histories.record import recording
from .input_tables import check_profiles
from .motion import speed_law, travel_time
from .run_record import doubts, programs, statistics
from .surfaces.tables import compose, written
from .watched_control import WatchedControl

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    import xarray as xr

    from fmu_src.building import FmuPaths
    from orchestrator import FmuSource, Outcome, Recorder, System
    from vehicle_fmu.speed import SpeedLaw

    from .scenario import Scenario
    from .signals import ContactSide
    from .watched_control import Progress


def run_passage(
    scenario: Scenario,
    *,
    fmus: str = "python",
    contact: ContactSide = "vehicle",
    timeout: float | None = None,
    replay: Path | None = None,
    directory: Path | None = None,
    histories: Path | None = None,
    notify: Callable[[str], None] | None = None,
    report: Callable[[Progress], None] | None = None,
) -> xr.Dataset:
    """Co-simulate a passage.

    Parameters
    ----------
    scenario : Scenario
        What to run.
    fmus : str
        Which build of the FMUs runs: ``python`` or ``native``.
    contact : {"vehicle", "track"}
        Which of the two FMUs has the contacts. On the track's side, nothing is iterated unless
        the scenario names the algorithm newton.
    timeout : float, optional
        Longest answer of an FMU to one call [s], each FMU then being in a process of its own.
    replay : Path, optional
        Replay file to write if the run fails.
    directory : Path, optional
        Where the FMUs are kept; `fmu_src.building.folder_of` without.
    histories : Path, optional
        New NetCDF file that the kept histories of a scenario with ``[keep]`` are written to while
        it runs; the file is then the result, and what is returned lacks its histories.
    notify : callable, optional
        Told in a few words when an FMU has to be built, and of what makes the result doubtful.
    report : callable, optional
        Told of the progress after every decision of the master.

    Returns
    -------
    xarray.Dataset
        See `dataset.assemble`, or with ``[keep]`` `ThinnedRecord`. Also after Ctrl-C, with the
        attribute ``complete`` then 0.

    Raises
    ------
    InputError
        For a scenario, a file it names or an FMU that cannot be used.
    RunError
        Where the co-simulation cannot go on; with the result so far.
    """
    scenario = with_steps_for(scenario, contact)
    law = speed_law(scenario.vehicle)
    check_profiles(scenario)
    surfaces = compose(scenario)
    paths = build_for(scenario, fmus, contact=contact, directory=directory, notify=notify)
    provenance = _provenance(paths)

    try:
        with (
            threadpool_limits(limits=1, user_api="blas"),  # the matrices are too small for more
            written(scenario, surfaces, replay=replay) as files,
            recording(scenario, contact, surfaces, histories=histories) as record,
        ):
            sources = fmu_sources(
                scenario, paths, law, contact=contact, timeout=timeout, surfaces=files
            )
            system = join(sources, scenario, contact)
            case = _case(scenario, law, system, sources, record.recorder, contact=contact)
            master = _master(system, case, record.recorder, report=report)

            def label(outcome: Outcome) -> xr.Dataset | None:
                made_by = {"fmus": fmus, "contact": contact, **provenance}
                return record.label(outcome, {**made_by, **statistics(outcome)})

            with keeping_evidence(case, replay, label):
                outcome = master.run(case.start_time, case.stop_time)
            result = label(outcome)
    except orchestrator.InputError as error:
        raise InputError(str(error)) from error
    if notify is not None:
        for doubt in doubts(outcome, system):
            notify(doubt)
    if result is None:
        raise RunError("interrupted before there was anything to keep")
    return result


def _case(
    scenario: Scenario,
    law: SpeedLaw,
    system: System,
    sources: tuple[FmuSource, ...],
    recorder: Recorder,
    *,
    contact: ContactSide,
) -> ReplayCase:
    """Say what is run over the whole way, and what it takes to repeat it."""
    return ReplayCase(
        name="passage",
        sources=sources,
        connections=system.connections,
        settings=master_settings(scenario, contact),
        events=tuple(located_events(scenario, contact)),
        observed=tuple(recorder.choose(system.variables())),
        start_time=0.0,
        stop_time=travel_time(law, scenario.distance),
    )


def _master(
    system: System,
    case: ReplayCase,
    recorder: Recorder,
    *,
    report: Callable[[Progress], None] | None,
) -> Master:
    control = case.settings.make_controller(case.stop_time)
    if report is not None:
        control = WatchedControl(control, stop_time=case.stop_time, report=report)
    return Master(
        system, case.settings, controller=control, events=case.events, observers=[recorder]
    )


def _provenance(paths: FmuPaths) -> dict[str, str]:
    """Say which programs and which FMUs made a result."""
    return {
        **programs(),
        "track_fmu_guid": fmpy.read_model_description(paths.track).guid,
        "vehicle_fmu_guid": fmpy.read_model_description(paths.vehicle).guid,
    }
