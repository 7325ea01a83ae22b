"""The time loop: attempt, accept or go back."""

from collections.abc import Sequence
from time import perf_counter

from .acceptance import Acceptance
from .attempts import Attempts
from .audit import Audit
from .block import Block
from .clock import Clock, Step
from .coupling import Coupling
from .decision import Accept
from .errors import ParticipantError, RunError, WiringError
from .events import Switches
from .exchange import Exchange
from .interrupt import Interrupt
from .last_attempt import LastAttempt
from .ledger import Ledger
from .observation import Observation
from .observers import Observer
from .outcome import StopReason
from .rejection import Rejection
from .settings import MasterSettings
from .step_control import StepController
from .step_log import StepLog
from .value_watch import ValueWatch


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
        self._clock = clock
        late = () if last is None else last.order
        self.saved = [
            stage for n, stage in enumerate(exchange.stages) if rolls_back and n not in late
        ]
        self.rolls_back = rolls_back
        self._observation = Observation(exchange, late, observers)
        self._ledger = ledger
        self._settings = settings
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
        self._attempts = Attempts(
            exchange=exchange,
            coupling=coupling,
            controller=controller,
            switches=switches,
            observation=self._observation,
            predicts=predicts,
            tolerance=settings.tolerance,
        )
        self._acceptance = Acceptance(
            attempts=self._attempts,
            exchange=exchange,
            coupling=coupling,
            controller=controller,
            switches=switches,
            clock=clock,
            last=last,
            saved=self.saved,
            predicts=predicts,
            observation=self._observation,
            ledger=ledger,
            audit=self.audit,
            log=self.log,
            watch=self.watch,
        )
        self._rejection = Rejection(
            attempts=self._attempts,
            exchange=exchange,
            controller=controller,
            switches=switches,
            clock=clock,
            rolls_back=rolls_back,
            limit=settings.max_rejections,
            log=self.log,
        )

    def run(self, interrupt: Interrupt) -> StopReason:
        """Step until the stop time, or until something ends the run early.

        Raises
        ------
        RunError
            When it cannot go on; the message names participant, time and cause.
        """
        clock, settings = self._clock, self._settings
        make, accept = self._attempts.make, self._acceptance.accept
        deadline = perf_counter() + (settings.max_wall_time or float("inf"))
        budget = settings.max_attempts or float("inf")
        self._begin()
        step = clock.plan(self._controller.first_step)
        while not interrupt.requested:
            if self.log.attempts >= budget:
                return StopReason.STEP_BUDGET
            if perf_counter() >= deadline:
                return StopReason.TIME_BUDGET
            self._attempting = step
            candidate, decision = make(step)
            if isinstance(decision, Accept):
                self._attempting = None
                self._rejection.end_row()
                wanted = accept(step, candidate, decision)
                if clock.finished:
                    return StopReason.FINISHED
                step = clock.plan(wanted)
            else:
                step = self._rejection.reject(step, candidate, decision)
        return StopReason.INTERRUPTED

    def _begin(self) -> None:
        outputs = self._exchange.outputs
        self._attempts.history.restart(outputs[self._exchange.value_places])
        if self._switches.names:
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
            values=self._attempts.history.last,
            slope=self._attempts.history.slope,
            jacobians=self._coupling.known(step.size),
            indicators=self._switches.values,
            states=states,
        )

    def repeat(self, attempt: LastAttempt) -> str | None:
        """Repeat an attempt, and say why it failed, or None if it did not.

        Raises
        ------
        WiringError
            When it is not an attempt of this system.
        ParticipantError
            When a participant died in it.
        """
        expected = len(self._exchange.value_names), len(self._switches.names)
        found = attempt.values.size, len(attempt.indicators)
        if found != expected or (attempt.slope is not None and attempt.slope.size != found[0]):
            raise WiringError(
                f"the attempt has {found[0]} exchanged values and {found[1]} indicators, the "
                f"system {expected[0]} and {expected[1]}: it belongs to another one."
            )
        for stage in self._exchange.stages:
            stage.resume(attempt.states[stage.participant.name])
        self._attempts.history.resume(attempt.values, attempt.slope)
        self._coupling.learn(attempt.jacobians)
        self._switches.start(attempt.indicators)
        step = Step(attempt.time, attempt.step_size, attempt.landing)
        candidate, decision = self._attempts.make(step)
        if isinstance(decision, Accept):
            return None
        return self._attempts.explain(candidate, decision.cause)
