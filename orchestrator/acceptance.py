"""What follows from an accepted attempt: time, history and states move on."""

from collections.abc import Sequence

from .attempts import Attempts
from .audit import Audit
from .block import Block
from .clock import Clock, Step
from .coupling import Coupling
from .decision import Accept, Candidate, Landed
from .errors import RunError
from .events import Switches
from .exchange import Exchange
from .ledger import Ledger
from .observation import Observation
from .stage import Stage
from .step_control import StepController
from .step_log import StepLog
from .value_watch import ValueWatch


class Acceptance:
    """Makes the end of an attempt the accepted point.

    Parameters
    ----------
    attempts : Attempts
        What was tried.
    exchange : Exchange
        Participants and the values between them.
    coupling : Coupling
        Keeps what it learned in the attempt.
    controller : StepController
        Says how large the first step after a switch shall be.
    switches : Switches
        Changes the sides of the indicators.
    clock : Clock
        The accepted time.
    last : Block or None
        The participant that cannot go back: it steps now.
    saved : sequence of Stage
        Those whose states are saved.
    predicts : bool
        Whether anything needs the prediction of exchanged values.
    observation : Observation
        Shows the accepted point to the observers.
    ledger : Ledger or None
        Adds up the energy of bonds, if there are any.
    audit : Audit or None
        Repeats the step, if the settings want it.
    log : StepLog
        One row per attempt.
    watch : ValueWatch
        Looks at the accepted values.
    """

    def __init__(
        self,
        *,
        attempts: Attempts,
        exchange: Exchange,
        coupling: Coupling,
        controller: StepController,
        switches: Switches,
        clock: Clock,
        last: Block | None,
        saved: Sequence[Stage],
        predicts: bool,
        observation: Observation,
        ledger: Ledger | None,
        audit: Audit | None,
        log: StepLog,
        watch: ValueWatch,
    ) -> None:
        self._attempts = attempts
        self._history = attempts.history
        self._exchange = exchange
        self._coupling = coupling
        self._controller = controller
        self._switches = switches
        self._has_events = bool(switches.names)
        self._clock = clock
        self._last = last
        self._saved = saved
        self._predicts = predicts
        self._observation = observation
        self._ledger = ledger
        self._audit = audit
        self._log = log
        self._watch = watch

    def accept(self, step: Step, candidate: Candidate, decision: Accept) -> float:
        """Move on to the end of an attempt, and return the size wanted for the next one [s].

        Raises
        ------
        RunError
            When the participant that steps last fails.
        ZenoError
            When switches do not end.
        """
        time, size, _ = step
        if self._last is not None:
            self._step_last(self._last, time, size)
        self._log.append(candidate, 0)
        self._coupling.commit()
        saved = self._audit is not None and self._audit.accept(
            time, size, self._history.last, self._attempts.predicted
        )
        self._clock.advance(step)
        outputs = self._exchange.outputs
        values = outputs[self._exchange.value_places]
        self._watch.accept(values, self._history.last)
        wanted = decision.next_step
        finding = candidate.finding
        if self._ledger is not None:
            self._ledger.accept(size, switched=isinstance(finding, Landed))
        if isinstance(finding, Landed):
            self._history.restart(values)
            self._coupling.forget()
            wanted = self._controller.after_switch()
        elif self._predicts:
            self._history.append(values, size)
        else:
            self._history.restart(values)
        if self._has_events:
            indicators = outputs[self._exchange.indicator_places].tolist()
            landed = finding if isinstance(finding, Landed) else None
            self._switches.accept(self._clock.time, size, indicators, landed)
        if not (saved or self._clock.finished):
            for stage in self._saved:
                stage.save()
        self._observation.notify(self._clock.time)
        return wanted

    def _step_last(self, last: Block, time: float, size: float) -> None:
        failure = last.step(self._attempts.predicted[last.unknowns], time, size)
        failure = failure or self._observation.read_late(time, size)
        if failure is not None:
            raise RunError(
                f"The participant that cannot go back failed in its only attempt: {failure.message}"
            )
