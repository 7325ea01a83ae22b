"""What follows from a rejected attempt: the next one, or the end of the run."""

from .attempts import Attempts
from .clock import Clock, Step
from .decision import Candidate, Cause, Reject
from .errors import RunError, StepTooSmallError
from .events import Switches
from .exchange import Exchange
from .step_control import StepController
from .step_log import StepLog


class Rejection:
    """Plans the attempt that follows a rejected one.

    Parameters
    ----------
    attempts : Attempts
        What was tried.
    exchange : Exchange
        Participants and the values between them.
    controller : StepController
        Knows the smallest step.
    switches : Switches
        Keeps or gives up the search for a switch.
    clock : Clock
        Plans steps.
    rolls_back : bool
        Whether states are saved, so that there can be another attempt.
    limit : int
        Rejections in a row that end the run.
    log : StepLog
        One row per attempt.
    """

    def __init__(
        self,
        *,
        attempts: Attempts,
        exchange: Exchange,
        controller: StepController,
        switches: Switches,
        clock: Clock,
        rolls_back: bool,
        limit: int,
        log: StepLog,
    ) -> None:
        self._attempts = attempts
        self._exchange = exchange
        self._controller = controller
        self._switches = switches
        self._clock = clock
        self._rolls_back = rolls_back
        self._limit = limit
        self._log = log
        self._in_a_row = 0
        self._error_forgiven = False

    def end_row(self) -> None:
        """Begin anew after an accepted attempt."""
        self._in_a_row = 0
        self._error_forgiven = False

    def reject(self, step: Step, candidate: Candidate, decision: Reject) -> Step:
        """Return the next attempt.

        Raises
        ------
        ParticipantError
            When a participant reports its second error in a row.
        RunError
            When there is no other attempt to make.
        """
        cause, wanted, exactly = decision
        self._check_row(candidate, cause)
        self._log.append(candidate, cause)
        error = candidate.failure.participant_error if candidate.failure else None
        if error is not None and self._error_forgiven:
            raise error
        self._error_forgiven = error is not None
        if not self._rolls_back:
            raise RunError(
                f"A step failed and cannot be repeated, because no states are saved for fixed "
                f"steps with an explicit algorithm unless min_step is given: "
                f"{self._attempts.explain(candidate, cause)}"
            )
        if error is not None and wanted < self._controller.min_step:
            return step  # the one repetition that an error is granted
        if cause is Cause.EVENT:
            self._switches.narrow()
            return self._clock.plan_exactly(wanted)
        if wanted == step.size:
            return step
        history = self._attempts.history
        if cause is Cause.ERROR and not history.has_past:
            exchange = self._exchange
            history.look_ahead(exchange.outputs[exchange.value_places], step.size)
        self._switches.abandon()
        if exactly:
            self._switches.count(step.start, "Steps ended early")
            return self._clock.plan_exactly(wanted)
        following = self._clock.plan(wanted)
        if wanted < self._controller.min_step or following.size >= step.size:
            raise StepTooSmallError(
                f"The step of {step.size:.6g} s at t = {step.start:.9g} s failed and cannot become "
                f"smaller than {self._controller.min_step:.6g} s: "
                f"{self._attempts.explain(candidate, cause)}"
            )
        return following

    def _check_row(self, candidate: Candidate, cause: Cause) -> None:
        self._in_a_row += 1
        if self._in_a_row > self._limit:
            raise RunError(
                f"{self._in_a_row} attempts in a row were rejected at "
                f"t = {self._clock.time:.9g} s, the last one because of {cause.name.lower()}: "
                f"{self._attempts.explain(candidate, cause)}"
            )
