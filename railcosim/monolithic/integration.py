"""Integration over the way, begun anew where what is given, a contact or a bump stop has a kink."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.optimize import brentq

from ..errors import RunError
from .integrators import start_integrator

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from .integrators import Accuracy, Stepper
    from .observation import Observer
    from .system import CoupledSystem

FIRST_STEP = 1e-6
"""After the start and after every switch [s]."""

SWITCH_TOLERANCE = 1e-12
"""How exactly a switch is found [s]."""


@dataclass(slots=True, kw_only=True)
class Effort:
    """What an integration took.

    Attributes
    ----------
    steps, evaluations, factorisations, switches : int
        Steps; evaluations of the derivative; factorised matrices; switches of contacts and stops.
    """

    steps: int = 0
    evaluations: int = 0
    factorisations: int = 0
    switches: int = 0


class Switch(NamedTuple):
    """A wheel that loses or recovers contact, or a bump stop that is met or left.

    Attributes
    ----------
    time : float
        When [s].
    margin : int or None
        Which of the margins of the system changes its sign, from 0; None where none does.
    """

    time: float
    margin: int | None


def integrate(
    system: CoupledSystem,
    state: NDArray[np.float64],
    accuracy: Accuracy,
    *,
    observer: Observer,
    report: Callable[[float, float], None] | None = None,
) -> Effort:
    """Integrate over the whole way.

    Between two kinks of the course everything given is smooth: steps end there and the next one
    begins anew with the step size kept. They end at every switch of a contact, too, where the
    second derivative of the contact force jumps, and of a bump stop. The kinks of one-sided dampers
    are left to the integrator.

    Parameters
    ----------
    system : CoupledSystem
        The system at the start.
    state : ndarray, shape (size,)
        At t = 0.
    accuracy : Accuracy
        Of the integration.
    observer : Observer
        Is shown every step.
    report : callable, optional
        Told of time and step size [s] after every step.

    Returns
    -------
    Effort
        What it took.

    Raises
    ------
    RunError
        If the integrator gives up.
    """
    effort, course = Effort(), system.places.course
    time, step = 0.0, FIRST_STEP
    apart = system.margins(time, state) > 0.0
    for end in (*course.kinks.tolist(), course.stop_time):
        system = system.moved_to(0.5 * (time + end))
        while time < end:
            solver = start_integrator(
                system, accuracy, time=time, state=state, end=end, first_step=min(step, end - time)
            )
            margin = None
            while solver.status == "running" and margin is None:
                _take_step(solver)
                solution = solver.dense_output()
                switch, margin = _first_switch(system, solver, solution, apart)
                time = min(switch, solver.t)
                state = solver.y if time == solver.t else solution(time)
                observer.see(system, solution, time)
                effort.steps += 1
                if report is not None:
                    report(time, solver.t - solver.t_old)
            step = solver.h_abs if margin is None else FIRST_STEP
            if margin is not None:
                apart[margin] = not apart[margin]
                effort.switches += 1
            effort.evaluations += solver.nfev
            effort.factorisations += solver.nlu
    return effort


def _take_step(solver: Stepper) -> None:
    """Take a step, or say why there is none."""
    message = solver.step()
    if solver.status == "failed" or not np.isfinite(solver.y).all():
        reason = message or "the state is not finite"
        raise RunError(
            f"the integration fails at t = {solver.t:.6g} s: {reason}; use a larger tolerance or "
            "the method Radau"
        )


def _first_switch(
    system: CoupledSystem,
    solver: Stepper,
    solution: Callable[[float], NDArray[np.float64]],
    apart: NDArray[np.bool_],
) -> Switch:
    """Find the first switch within the last step; ``apart`` is set right where it was rounding."""
    first = Switch(math.inf, None)
    now = system.margins(solver.t, solver.y)
    for margin in np.flatnonzero((now > 0.0) != apart).tolist():

        def value(time: float, margin: int = margin) -> float:
            return float(system.margins(time, solution(time))[margin])

        if value(solver.t_old) * value(solver.t) >= 0.0:
            apart[margin] = bool(now[margin] > 0.0)
            continue
        found = float(brentq(value, solver.t_old, solver.t, xtol=SWITCH_TOLERANCE))
        if found < first.time:
            first = Switch(found, margin)
    return first
