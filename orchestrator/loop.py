"""The time loop: attempt, decide, accept or go back."""

from collections.abc import Sequence
from time import perf_counter

import numpy as np

from .audit import Audit
from .block import Block
from .clock import Clock, Step
from .coupling import Coupling
from .decision import Accept, Candidate, Cause, Decision, Landed, Reject
from .errors import ParticipantError, RunError, StepTooSmallError
from .events import Switches
from .exchange import Exchange
from .explanation import explain
from .interrupt import Interrupt
from .last_attempt import LastAttempt
from .ledger import Ledger
from .observation import Observation
from .observers import Observer
from .outcome import StopReason
from .participant import Vector
from .prediction import History
from .quasi_newton import largest
from .settings import MasterSettings
from .step_control import StepController
from .step_log import StepLog
from .value_watch import ValueWatch

nan = float("nan")


class Loop:
    """Brings an initialised system from the start to the stop time.

    Parameters
    ----------
    exchange : Exchange
        Participants and the values between them.
    coupling : Coupling
        Finds the exchanged values of a step.
    controller : StepController
        Decides on attempts.
    switches : Switches
        Locates changes of side of the indicators.
    clock : Clock
        The accepted time.
    last : Block or None
        The participant that cannot go back: it steps when a step has been accepted.
    rolls_back : bool
        Whether states are saved, so that attempts can be rejected.
    predicts : bool
        Whether anything needs the prediction of exchanged values.
    observers : sequence of Observer
        Who sees the accepted points.
    ledger : Ledger or None
        Adds up the energy of bonds, if there are any.
    settings : MasterSettings
        Tolerance and limits.

    Attributes
    ----------
    audit : Audit or None
        Repeats accepted steps, if the settings want it.
    saved : list of Stage
        Those whose states are saved at every accepted point.
    log : StepLog
        One row per attempt so far.
    watch : ValueWatch
        Looks at the accepted values.
    """

    def __init__(
        self,
        *,
        exchange: Exchange,
        coupling: Coupling,
        controller: StepController,
        switches: Switches,
        clock: Clock,
        last: Block | None,
        rolls_back: bool,
        predicts: bool,
        observers: Sequence[Observer],
        ledger: Ledger | None,
        settings: MasterSettings,
    ) -> None:
        self._exchange = exchange
        self._coupling = coupling
        self._controller = controller
        self._switches = switches
        self._has_events = bool(switches.names)
        self._clock = clock
        self._last = last
        late = () if last is None else last.order
        self.saved = [
            stage for n, stage in enumerate(exchange.stages) if rolls_back and n not in late
        ]
        self.rolls_back = rolls_back
        self._predicts = predicts
        self._observation = Observation(exchange, late, observers)
        self._ledger = ledger
        self._settings = settings
        self._history = History(exchange.lower, exchange.upper)
        self._predicted: Vector = self._history.last
        allowed = exchange.nominal * (settings.tolerance or 1.0)
        self._weights: Vector = exchange.continuous / allowed
        # What has no continuous value to predict makes no error that could be seen.
        self._unpredicted = nan if exchange.continuous.any() else 0.0
        self._error_forgiven = False
        self._attempting: Step | None = None
        self.audit: Audit | None = None
        if settings.audit is not None:
            self.audit = Audit(
                exchange,
                coupling,
                self.saved,
                every=settings.audit,
                tolerance=settings.tolerance if controller.uses_error else None,
            )
        self.log = StepLog()
        controlled = settings.tolerance if controller.uses_error else None
        iterated = settings.coupling_tolerance if coupling.iterates else None
        self.watch = ValueWatch(exchange, controlled=controlled, resolved=controlled or iterated)

    def run(self, interrupt: Interrupt) -> StopReason:
        """Step until the stop time, or until something ends the run early.

        Raises
        ------
        RunError
            When it cannot go on; the message names participant, time and cause.
        """
        clock, settings = self._clock, self._settings
        deadline = perf_counter() + (settings.max_wall_time or float("inf"))
        budget = settings.max_attempts or float("inf")
        self._begin()
        step = clock.plan(self._controller.first_step)
        in_a_row = 0
        while not interrupt.requested:
            if self.log.attempts >= budget:
                return StopReason.STEP_BUDGET
            if perf_counter() >= deadline:
                return StopReason.TIME_BUDGET
            candidate, decision = self._try(step)
            if isinstance(decision, Accept):
                in_a_row = 0
                wanted = self._accept(step, candidate, decision)
                if clock.finished:
                    return StopReason.FINISHED
                step = clock.plan(wanted)
            else:
                in_a_row += 1
                if in_a_row > settings.max_rejections:
                    raise RunError(
                        f"{in_a_row} attempts in a row were rejected at t = {clock.time:.9g} s, "
                        f"the last one because of {decision.cause.name.lower()}: "
                        f"{self._explain(candidate, decision.cause)}"
                    )
                step = self._reject(step, candidate, decision)
        return StopReason.INTERRUPTED

    def _begin(self) -> None:
        outputs = self._exchange.outputs
        self._history.restart(outputs[self._exchange.value_places])
        if self._has_events:
            self._switches.start(outputs[self._exchange.indicator_places].tolist())
        if self._ledger is not None:
            self._ledger.start()
        for stage in self.saved:
            stage.save()
        time, observation = self._clock.time, self._observation
        failure = observation.read(time) or observation.read_late(time)
        if failure is not None:
            raise RunError(failure.message)
        observation.notify(time)

    def last_attempt(self) -> LastAttempt | None:
        """Return what it takes to repeat an attempt that failed, where states can be serialised."""
        step, stages = self._attempting, self._exchange.stages
        able = [stage for stage in self.saved if stage.participant.can_serialise_state]
        if step is None or len(able) < len(stages) or self._switches.searching:
            return None
        try:
            states = {stage.participant.name: stage.serialise() for stage in stages}
        except ParticipantError:
            return None  # it died, or it claims too much: the whole run can be repeated
        return LastAttempt(
            time=step.start,
            step_size=step.size,
            landing=step.landing,
            values=self._history.last,
            slope=self._history.slope,
            jacobians=self._coupling.known(step.size),
            indicators=self._switches.values,
            states=states,
        )

    def repeat(self, attempt: LastAttempt) -> str | None:
        """Repeat an attempt, and say why it failed, or None if it did not.

        Raises
        ------
        ParticipantError
            When a participant died in it.
        """
        for stage in self._exchange.stages:
            stage.resume(attempt.states[stage.participant.name])
        self._history.resume(attempt.values, attempt.slope)
        self._coupling.learn(attempt.jacobians)
        self._switches.start(attempt.indicators)
        candidate, decision = self._try(Step(attempt.time, attempt.step_size, attempt.landing))
        return None if isinstance(decision, Accept) else self._explain(candidate, decision.cause)

    def _try(self, step: Step) -> tuple[Candidate, Decision]:
        self._attempting = step
        candidate = self._attempt(step)
        decision = self._controller.decide(candidate)
        if isinstance(decision, Accept):
            failure = self._observation.read(step.start, step.size)
            if failure is not None:
                candidate = candidate._replace(failure=failure)
                decision = self._controller.decide(candidate)
        return candidate, decision

    def _attempt(self, step: Step) -> Candidate:
        time, size, _ = step
        history, outputs = self._history, self._exchange.outputs
        predicted = history.predict(size) if self._predicts else history.last
        self._predicted = predicted
        failure, iterations, residual = self._coupling.attempt(time, size, history.last, predicted)
        finding, error = None, nan
        if failure is None:
            if self._has_events:
                indicators = outputs[self._exchange.indicator_places].tolist()
                finding = self._switches.examine(size, indicators)
            if self._controller.uses_error:
                error = self._unpredicted
                if history.has_slope:
                    values = outputs[self._exchange.value_places]
                    miss = largest((values - predicted) * self._weights)
                    error = miss * history.curvature_factor(size)
        return Candidate(time, size, failure, finding, error, iterations, residual)

    def _accept(self, step: Step, candidate: Candidate, decision: Accept) -> float:
        time, size, _ = step
        self._attempting = None
        if self._last is not None:
            self._step_last(time, size)
        self.log.append(candidate, 0)
        self._error_forgiven = False
        self._coupling.commit()
        saved = self.audit is not None and self.audit.accept(
            time, size, self._history.last, self._predicted
        )
        self._clock.advance(step)
        outputs = self._exchange.outputs
        values = outputs[self._exchange.value_places]
        self.watch.accept(values, self._history.last)
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
            for stage in self.saved:
                stage.save()
        self._observation.notify(self._clock.time)
        return wanted

    def _step_last(self, time: float, size: float) -> None:
        assert self._last is not None
        failure = self._last.step(self._predicted[self._last.unknowns], time, size)
        failure = failure or self._observation.read_late(time, size)
        if failure is not None:
            raise RunError(
                f"The participant that cannot go back failed in its only attempt: {failure.message}"
            )

    def _reject(self, step: Step, candidate: Candidate, decision: Reject) -> Step:
        cause, wanted, exactly = decision
        self.log.append(candidate, cause)
        error = candidate.failure.participant_error if candidate.failure else None
        if error is not None and self._error_forgiven:
            raise error
        self._error_forgiven = error is not None
        if not self.rolls_back:
            raise RunError(
                f"A step failed and cannot be repeated, because no states are saved for fixed "
                f"steps with an explicit algorithm unless min_step is given: "
                f"{self._explain(candidate, cause)}"
            )
        if error is not None and wanted < self._controller.min_step:
            return step  # the one repetition that an error is granted
        if cause is Cause.EVENT:
            self._switches.narrow()
            return self._clock.plan_exactly(wanted)
        if wanted == step.size:
            return step
        if cause is Cause.ERROR and not self._history.has_past:
            exchange = self._exchange
            self._history.look_ahead(exchange.outputs[exchange.value_places], step.size)
        if self._has_events:
            self._switches.abandon()
        if exactly:
            self._switches.count(step.start, "Steps ended early")
            return self._clock.plan_exactly(wanted)
        following = self._clock.plan(wanted)
        if wanted < self._controller.min_step or following.size >= step.size:
            raise StepTooSmallError(
                f"The step of {step.size:.6g} s at t = {step.start:.9g} s failed and cannot become "
                f"smaller than {self._controller.min_step:.6g} s: {self._explain(candidate, cause)}"
            )
        return following

    def _explain(self, candidate: Candidate, cause: Cause) -> str:
        exchange = self._exchange
        values = exchange.outputs[exchange.value_places]
        return explain(candidate, cause, exchange, np.abs(values - self._predicted) * self._weights)
