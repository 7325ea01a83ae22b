"""A scenario solved as one system of equations."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, get_args

import numpy as np
from threadpoolctl import threadpool_limits

from ..dataset import assemble as label
from ..errors import InputError
from ..input_tables import check_profiles
from ..run_record import ATTEMPT_COLUMNS, programs
from ..summary import CAUSES
from ..surfaces.tables import compose
from ..watched_control import Progress
from .course import course_of
from .held_track import held_track
from .integration import integrate
from .integrators import Accuracy
from .observation import Observer
from .scenario_system import Model, make_system
from .system import ContactForm

if TYPE_CHECKING:
    from collections.abc import Callable

    import xarray as xr
    from numpy.typing import NDArray

    from ..scenario import Scenario
    from .integration import Effort

SAMPLING = 5e-5
"""Distance of the times of a result where none are given [s]."""

ROUNDING = 1e-9
"""How far beyond the end of the run a given time may lie [s]."""


def solve(
    scenario: Scenario,
    *,
    model: Model = "modal",
    contact_form: ContactForm = "hertz",
    accuracy: Accuracy | None = None,
    times: NDArray[np.float64] | None = None,
    report: Callable[[Progress], None] | None = None,
) -> xr.Dataset:
    """Solve a passage as one system of equations, Eq. (15)-(18).

    Every support has the laws of its ballast and its pad, whatever ``track.supports_per_wheel``
    says; the section ``[master]`` has no meaning here.

    Parameters
    ----------
    scenario : Scenario
        What passes.
    model : {"modal", "full"}
        Complex modes, as many as the scenario says, with residual flexibility; or the whole finite
        element track.
    contact_form : {"hertz", "constraint"}
        How the contact is written; see `system`. The solutions agree.
    accuracy : Accuracy, optional
        Integrator and tolerances.
    times : ndarray, shape (m,), optional
        When to observe [s], increasing; every 50 us without.
    report : callable, optional
        Told of the progress after every step.

    Returns
    -------
    xarray.Dataset
        As from a co-simulation, but without a step log; ``iterations`` counts evaluations.

    Raises
    ------
    InputError
        For a file that the scenario names, or an argument, that cannot be used.
    RunError
        Where the integration cannot go on.
    """
    begun = time.perf_counter()
    for name, value, kind in (
        ("model", model, Model),
        ("contact_form", contact_form, ContactForm),
    ):
        if value not in get_args(kind):
            raise InputError(f"{name} is {value!r} but must be one of {', '.join(get_args(kind))}")
    check_profiles(scenario)
    held, surfaces = held_track(scenario), compose(scenario)
    with threadpool_limits(limits=1, user_api="blas"):  # the matrices are too small for more
        course = course_of(scenario, surfaces)
        system, state = make_system(scenario, held, course, model=model, contact_form=contact_form)
        stop = course.stop_time
        observer = Observer(
            _sampling(times, stop),
            gauges=np.array(scenario.gauge_positions) - held.begin,
            sleepers=held.sleepers_of(scenario),
        )
        effort = integrate(
            system,
            state,
            accuracy or Accuracy(),
            observer=observer,
            report=None
            if report is None
            else lambda now, step: report(Progress(now, stop, step, 0)),
        )
    attributes = {"model": model, "contact_form": contact_form, **programs()}
    return label(
        scenario,
        times=observer.times,
        series=observer.series(),
        surfaces=surfaces,
        attempts={
            name: np.empty(0, "U8" if name == "cause" else float) for name in ATTEMPT_COLUMNS
        },
        attributes=attributes | _statistics(effort, stop, time.perf_counter() - begun),
    )


def _sampling(times: NDArray[np.float64] | None, stop: float) -> NDArray[np.float64]:
    """Return the times of the result, checked."""
    if times is None:
        return np.linspace(0.0, stop, round(stop / SAMPLING) + 2)
    if (
        times.ndim != 1
        or times.size < 2
        or not (np.diff(times) > 0.0).all()
        or times[0] < 0.0
        or times[-1] > stop + ROUNDING
    ):
        raise InputError(
            f"the times of a result must be two or more, increase and lie between 0 and {stop:g} s"
        )
    return np.minimum(times, stop)


def _statistics(effort: Effort, stop: float, wall_time: float) -> dict[str, str | int | float]:
    """Say how it went, in the words of a co-simulation."""
    return {
        "complete": 1,
        "stop_reason": "finished",
        "simulated_time": stop,
        "wall_time": wall_time,
        "iterations": effort.evaluations,
        "factorisations": effort.factorisations,
        "switches": effort.switches,
        "steps_accepted": effort.steps,
        "warnings": "",
        "unreliable": "",
        **{f"steps_rejected_{cause}": 0 for cause in CAUSES},
    }
