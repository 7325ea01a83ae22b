"""The master on anyone's FMUs: from a system description to a result."""

from __future__ import annotations

from typing import TYPE_CHECKING

from threadpoolctl import threadpool_limits

import orchestrator
from orchestrator import LastPoint, Master, Recorder, bond_by_unit
from orchestrator.replay import ReplayCase
from orchestrator.ssp import open_system

from .cosim_result import label_result
from .errors import InputError
from .evidence import keeping_evidence
from .run_record import doubts
from .watched_control import WatchedControl

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    import xarray as xr

    from orchestrator import Outcome
    from orchestrator.ssp import AssembledSystem

    from .cosim_options import CosimOptions
    from .watched_control import Progress


def run_system(
    path: Path,
    options: CosimOptions,
    *,
    timeout: float | None = None,
    replay: Path | None = None,
    with_histories: bool = True,
    notify: Callable[[str], None] | None = None,
    report: Callable[[Progress], None] | None = None,
) -> xr.Dataset:
    """Co-simulate the system of a file.

    Parameters
    ----------
    path : Path
        An .ssp or .ssd file.
    options : CosimOptions
        What counts more than what the file says.
    timeout : float, optional
        Longest answer of an FMU to one call [s], each FMU then being in a process of its own.
    replay : Path, optional
        Replay file to write if the run fails.
    with_histories : bool
        Whether outputs are kept over time, or their last values only.
    notify : callable, optional
        Told in a few words of parameter values that no variable has.
    report : callable, optional
        Told of the progress after every decision of the master.

    Returns
    -------
    xarray.Dataset
        See `label_result`. Also after Ctrl-C, with the attribute ``complete`` then 0.

    Raises
    ------
    InputError
        For a file, an FMU or an option that cannot be used.
    RunError
        Where the co-simulation cannot go on; with the result so far.
    """
    try:
        # The FMUs share the process and its BLAS: their matrices are too small for more threads.
        with (
            open_system(path, timeout=timeout) as opened,
            threadpool_limits(limits=1, user_api="blas"),
        ):
            for name in opened.unused:
                if notify is not None:
                    notify(f"no variable takes the parameter value {name}: it is not used")
            recorder = Recorder() if with_histories else LastPoint()
            return _run(opened, options, recorder, replay=replay, notify=notify, report=report)
    except orchestrator.InputError as error:
        raise InputError(str(error)) from error


def _run(
    opened: AssembledSystem,
    options: CosimOptions,
    recorder: Recorder,
    *,
    replay: Path | None,
    notify: Callable[[str], None] | None,
    report: Callable[[Progress], None] | None,
) -> xr.Dataset:
    choices = opened.description.master
    start, stop = options.span(opened.description)
    settings = options.settings(choices)
    control = settings.make_controller(stop - start)
    if report is not None:
        control = WatchedControl(control, stop_time=stop, report=report)
    events = options.events or choices.events
    name = opened.description.name
    master = Master(
        opened.system,
        settings,
        controller=control,
        events=events,
        observers=[recorder],
        bonds=[bond_by_unit(opened.system, *pair) for pair in options.pairs(choices)],
    )
    case = ReplayCase(
        name=name,
        sources=opened.sources,
        connections=opened.system.connections,
        settings=settings,
        events=events,
        observed=tuple(recorder.choose(opened.system.variables())),
        start_time=start,
        stop_time=stop,
    )

    def label(outcome: Outcome) -> xr.Dataset | None:
        return label_result(name, recorder, outcome, settings) if recorder.time.size else None

    with keeping_evidence(case, replay, label):
        outcome = master.run(start, stop)
    if notify is not None:
        for doubt in doubts(outcome, opened.system):
            notify(doubt)
    return label_result(name, recorder, outcome, settings)
