"""A step controller that tells what it decides, so that a run can be followed live."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from orchestrator import Accept

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestrator import Candidate, Decision, StepController


class Progress(NamedTuple):
    """How far a run is.

    Attributes
    ----------
    time, stop_time : float
        Accepted time and the end of the run [s].
    step_size : float
        Size of the last attempt [s].
    rejected : int
        Attempts rejected so far.
    """

    time: float
    stop_time: float
    step_size: float
    rejected: int


class WatchedControl:
    """Step controller that passes everything on to another one and reports every decision.

    Parameters
    ----------
    control : StepController
        Who decides.
    stop_time : float
        End of the run [s].
    report : callable
        Told of the progress after every decision.
    """

    def __init__(
        self, control: StepController, *, stop_time: float, report: Callable[[Progress], None]
    ) -> None:
        self._control = control
        self._stop_time = stop_time
        self._report = report
        self._rejected = 0
        self.first_step = control.first_step
        self.min_step = control.min_step
        self.grid = control.grid
        self.may_reject = control.may_reject
        self.uses_error = control.uses_error

    def decide(self, candidate: Candidate) -> Decision:
        """Let the other one decide, and report it."""
        decision = self._control.decide(candidate)
        accepted = isinstance(decision, Accept)
        self._rejected += not accepted
        time = candidate.time + candidate.step_size if accepted else candidate.time
        self._report(Progress(time, self._stop_time, candidate.step_size, self._rejected))
        return decision

    def after_switch(self) -> float:
        """Return what the other one says."""
        return self._control.after_switch()
