"""Who decides on an attempt and chooses the size of the next one."""

from bisect import bisect_right
from typing import Protocol

from .decision import Accept, Candidate, Cause, Decision, Refine, Reject
from .errors import SettingsError

order = 2
"""The difference of a straight-line prediction and the result is O(h^order)."""
safety = 0.8
growth_limit = 2.0
shrink_limit = 0.2
smallest_error = 1e-2
"""Errors below this are all the same to the controller."""
grid_ratio = 2.0**0.25
restart_factor = 0.1
"""First trial after a switch over the step before it."""
patience = {Cause.ERROR: 1, Cause.CONVERGENCE: 5, Cause.DISCARD: 5, Cause.INVALID: 5}
"""Accepted steps before the step may grow again after a rejection."""


class StepController(Protocol):
    """Decides on every attempt and remembers what it needs for the next."""

    @property
    def first_step(self) -> float:
        """Size wanted for the first step [s]."""

    @property
    def min_step(self) -> float:
        """Smallest step it may be asked for [s], steps onto a switch excepted."""

    @property
    def grid(self) -> float | None:
        """Spacing of the time points it wants to meet [s], if it steps at a fixed pace."""

    @property
    def may_reject(self) -> bool:
        """Whether attempts may have to be repeated because of what it decides."""

    @property
    def uses_error(self) -> bool:
        """Whether it needs the error norm of the candidates."""

    def decide(self, candidate: Candidate) -> Decision:
        """Accept or reject an attempt.

        Called once for every attempt, and once more when one that was accepted turns out to have
        observed values that are not finite.
        """

    def after_switch(self) -> float:
        """Return the size wanted for the first step after a switch [s]."""


class FixedStep:
    """Steps of one size, shortened only to land on switches.

    Parameters
    ----------
    step_size : float
        The size [s].
    min_step : float, optional
        If given, a step that fails is replaced by halves, quarters and so on, down to this [s].
    """

    uses_error = False

    def __init__(self, step_size: float, min_step: float | None = None) -> None:
        self.first_step = step_size
        self.grid: float | None = step_size
        self.min_step = step_size if min_step is None else min(min_step, step_size)

    @property
    def may_reject(self) -> bool:
        """Whether there is a smaller step to try."""
        return self.min_step < self.first_step

    def decide(self, candidate: Candidate) -> Decision:
        """Accept whatever has a result and ends on a switch if it meets one."""
        if candidate.failure is not None:
            early = early_end(candidate) if self.may_reject else None
            return early or Reject(candidate.failure.cause, smaller_step(candidate, self.min_step))
        if isinstance(candidate.finding, Refine):
            return Reject(Cause.EVENT, candidate.finding.next_step)
        return Accept(self.first_step)

    def after_switch(self) -> float:
        """Return the fixed size: the clock cuts it at the next grid point."""
        return self.first_step


class ErrorControl:
    """Keeps the difference of prediction and result below the tolerance.

    The next step is the one at which the curvature just found meets the tolerance, rounded down to
    a geometric grid below the largest step, since participants may keep operators per step size.
    The size follows from the present course alone and not from the sizes before it: a conservative
    system that goes one way and back is stepped alike both ways, so that its errors cancel, which
    a controller with a memory undoes (Hairer, Lubich & Wanner, Geometric Numerical Integration,
    section VIII.3).

    A first step, at the start and after a switch, has no past to predict it. Its first trial is
    only looked at: it is repeated with half its size, the trial giving the slope, and judged like
    any other step; see Hairer, Norsett & Wanner, Solving ODEs I, section II.4, for starting steps
    from a trial.

    Parameters
    ----------
    initial_step, min_step, max_step : float
        First, smallest and largest step [s].
    """

    uses_error = True
    may_reject = True
    grid = None

    def __init__(self, *, initial_step: float, min_step: float, max_step: float) -> None:
        if not 0.0 < min_step <= initial_step <= max_step:
            raise SettingsError(
                f"steps must satisfy 0 < smallest <= initial <= largest, "
                f"not {min_step} <= {initial_step} <= {max_step} s."
            )
        self.min_step = min_step
        sizes = [max_step]
        while sizes[-1] / grid_ratio > min_step * (1.0 + 1e-9):
            sizes.append(max_step * grid_ratio ** -len(sizes))
        if min_step < sizes[-1]:
            sizes.append(min_step)
        self._sizes = sizes[::-1]
        self.first_step = self._round_down(initial_step)
        self._step = self.first_step
        self._patience = 0

    def decide(self, candidate: Candidate) -> Decision:
        """Reject what failed, missed a switch or differs too much from the prediction."""
        failure, finding, error = candidate.failure, candidate.finding, candidate.error_norm
        if failure is not None:
            early = early_end(candidate)
            if early is not None:
                return early
            self._patience = patience[failure.cause]
            self._step = self._round_down(smaller_step(candidate, self.min_step))
            return Reject(failure.cause, self._step)
        if isinstance(finding, Refine) and (finding.crossed or not error > 1.0):
            return Reject(Cause.EVENT, finding.next_step)
        if error > 1.0:
            self._patience = max(self._patience, patience[Cause.ERROR])
            factor = max(shrink_limit, safety * error ** (-1.0 / order))
            return Reject(Cause.ERROR, self._below(candidate.step_size, factor))
        unknown = error != error  # noqa: PLR0124 - NaN: nothing was predicted
        if unknown and candidate.step_size >= 2.0 * self.min_step:
            return Reject(Cause.ERROR, self._round_down(0.5 * candidate.step_size))
        return Accept(self._step if unknown else self._next(candidate.step_size, error))

    def after_switch(self) -> float:
        """Return a tenth of the step that was going on before the switch."""
        self._step = self._round_down(max(self.min_step, restart_factor * self._step))
        return self._step

    def _next(self, size: float, error: float) -> float:
        patient = self._patience > 0
        self._patience = max(0, self._patience - 1)
        factor = safety * max(error, smallest_error) ** (-1.0 / order)
        limit = 1.0 if patient else growth_limit
        factor = min(limit, max(shrink_limit, factor))
        # A step cut short by the stop time or a switch says nothing against the size before it.
        wanted = factor * size if size >= self._step else max(factor * size, self._step)
        self._step = self._round_down(max(self.min_step, wanted))
        return self._step

    def _below(self, size: float, factor: float) -> float:
        if size <= self.min_step:
            return factor * size
        self._step = self._round_down(max(self.min_step, factor * size))
        return self._step

    def _round_down(self, size: float) -> float:
        # The margin keeps a grid size that was multiplied by a factor of one where it is.
        place = bisect_right(self._sizes, size * (1.0 + 1e-12))
        return self._sizes[place - 1] if place else size


def early_end(candidate: Candidate) -> Reject | None:
    """Return the order to end the step where a participant ended it early, if one did."""
    failure = candidate.failure
    if failure is None or not failure.ends_early or failure.last_successful_time is None:
        return None
    reached = failure.last_successful_time - candidate.time
    return Reject(failure.cause, reached, exactly=True)


def smaller_step(candidate: Candidate, min_step: float) -> float:
    """Return the step to try after a failure [s]: as far as it went, or else half of it."""
    half = 0.5 * candidate.step_size
    failure = candidate.failure
    if failure is not None and failure.last_successful_time is not None:
        reached = failure.last_successful_time - candidate.time
        if reached < candidate.step_size:
            half = max(half, reached)
    if candidate.step_size <= min_step:
        return half
    return max(half, min_step)
