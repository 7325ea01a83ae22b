"""What the user can choose about the master."""

from dataclasses import dataclass
from math import inf
from typing import Literal

from .coupling import Algorithm
from .errors import SettingsError
from .explicit import Explicit
from .newton import Newton
from .step_control import ErrorControl, FixedStep, StepController

algorithms = ("newton", "gauss_seidel", "jacobi")
counts = ("max_iterations", "max_switches", "max_rejections", "max_attempts", "audit")


@dataclass(frozen=True, slots=True, kw_only=True)
class MasterSettings:
    """Settings of a run, checked on construction.

    Attributes
    ----------
    tolerance : float or None
        Allowed difference of prediction and result of every exchanged value in one step, relative
        to its nominal value, the prediction being a straight line from equal steps. None is for
        fixed steps only, which control no error.
    algorithm : {'newton', 'gauss_seidel', 'jacobi'}
        How the exchanged values are found.
    extrapolate : bool
        Whether explicit algorithms continue inputs on straight lines or hold them.
    fixed_step : float or None
        Step size [s] without error control; None for error control.
    initial_step, min_step, max_step : float or None
        First trial, smallest and largest step [s]. By default the largest is a tenth of the run,
        the first a hundredth of the largest and the smallest 1e-6 of the largest. With fixed steps
        only `min_step` is used: if given, failing steps are divided down to it.
    coupling_tolerance : float
        Largest residual of the iteration relative to the nominal value.
    max_iterations : int
        How often one attempt may correct the exchanged values.
    event_tolerance : float
        Values of an indicator up to this count as zero, in its unit.
    event_time_tolerance : float
        Width of the time bracket that locates a switch well enough [s].
    max_switches : int
        Switches allowed within `switch_window`.
    switch_window : float or None
        Time span for `max_switches` [s]; 1e-6 of the run by default, which lets fast switching
        pass.
    accumulation_share : float
        Switches whose intervals shrink by a constant ratio end the run when what is left of the
        series is less than this over what has passed of it. The smaller, the more of them are
        located, and the shorter a contact may be that is none of a rigid body.
    max_rejections : int
        Rejected attempts in a row that end the run.
    max_attempts : int or None
        Attempts after which the run ends early.
    max_wall_time : float or None
        Seconds of wall time after which the run ends early.
    audit : int or None
        Every so many accepted steps are repeated in two halves to measure their error, which
        leaves the run as it is.
    check_rollback : bool
        Whether participants must prove at the start that they can go back. Without it, an explicit
        run with fixed steps and without `min_step` does not measure the gain of its loops either.
    """

    tolerance: float | None
    algorithm: Literal["newton", "gauss_seidel", "jacobi"] = "newton"
    extrapolate: bool = True
    fixed_step: float | None = None
    initial_step: float | None = None
    min_step: float | None = None
    max_step: float | None = None
    coupling_tolerance: float = 1e-7
    max_iterations: int = 20
    event_tolerance: float = 1e-10
    event_time_tolerance: float = 1e-9
    max_switches: int = 50
    switch_window: float | None = None
    accumulation_share: float = 1e-3
    max_rejections: int = 100
    max_attempts: int | None = None
    max_wall_time: float | None = None
    audit: int | None = None
    check_rollback: bool = True

    def __post_init__(self) -> None:
        if self.algorithm not in algorithms:
            raise SettingsError(
                f"algorithm {self.algorithm!r} is none of {', '.join(map(repr, algorithms))}."
            )
        for name in (
            "tolerance",
            "fixed_step",
            "initial_step",
            "min_step",
            "max_step",
            "coupling_tolerance",
            "event_tolerance",
            "event_time_tolerance",
            "switch_window",
            "accumulation_share",
            "max_wall_time",
        ):
            value = getattr(self, name)
            if value is not None and not 0.0 < value < inf:
                raise SettingsError(f"{name} = {value} must be positive and finite.")
        for name in counts:
            value = getattr(self, name)
            if value is not None and value < 1:
                raise SettingsError(f"{name} = {value} must be at least 1.")
        self._check_steps()

    def _check_steps(self) -> None:
        if self.fixed_step is None:
            if self.tolerance is None:
                raise SettingsError(
                    "give a tolerance, or a fixed_step to do without error control."
                )
        elif self.initial_step is not None or self.max_step is not None:
            raise SettingsError(
                "fixed_step leaves no choice of initial_step and max_step; give one or the other."
            )
        elif self.min_step is not None and self.min_step > self.fixed_step:
            raise SettingsError(
                f"min_step = {self.min_step} s must not exceed fixed_step = {self.fixed_step} s."
            )

    def make_algorithm(self) -> Algorithm:
        """Return the coupling algorithm chosen."""
        if self.algorithm == "newton":
            return Newton(tolerance=self.coupling_tolerance, max_iterations=self.max_iterations)
        return Explicit(tears_everything=self.algorithm == "jacobi", extrapolates=self.extrapolate)

    def make_controller(self, duration: float) -> StepController:
        """Return the step controller chosen, for a run of `duration` [s]."""
        if self.fixed_step is not None:
            return FixedStep(self.fixed_step, self.min_step)
        max_step = min(self.max_step or 0.1 * duration, duration)
        first = self.initial_step or max(0.01 * max_step, self.min_step or 0.0)
        initial_step = min(first, max_step)
        min_step = self.min_step or min(1e-6 * max_step, initial_step)
        return ErrorControl(initial_step=initial_step, min_step=min_step, max_step=max_step)
