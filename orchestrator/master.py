"""The co-simulation master: initialises a system, runs it and cleans up."""

import logging
from collections.abc import Sequence
from contextlib import ExitStack
from time import perf_counter

from .bond import Bond
from .clock import Step
from .coupling import Algorithm
from .errors import RunError
from .initialisation import settle_initial_values
from .interrupt import Interrupt, deferred_interrupt
from .last_attempt import LastAttempt
from .loop_gain import estimate_loop_gains, review_loop_gains
from .observers import Observer
from .outcome import Outcome, StopReason
from .preparation import Choices, Prepared, prepare
from .rollback import check_rollback
from .settings import MasterSettings
from .step_control import StepController
from .system import System

logger = logging.getLogger(__name__)


class Master:
    """Runs a system of participants.

    Parameters
    ----------
    system : System
        Participants and connections.
    settings : MasterSettings
        Tolerances and limits.
    algorithm : Algorithm, optional
        Coupling algorithm in place of the one that the settings name.
    controller : StepController, optional
        Step controller in place of the one that the settings describe.
    events : sequence of str
        Signed outputs, as ``participant.variable``, whose changes of sign are located.
    observers : sequence of Observer
        Who sees the accepted points.
    bonds : sequence of Bond
        Pairs of connections whose energy is added up.

    Raises
    ------
    WiringError
        When an indicator or a chosen variable does not exist.
    """

    def __init__(
        self,
        system: System,
        settings: MasterSettings,
        *,
        algorithm: Algorithm | None = None,
        controller: StepController | None = None,
        events: Sequence[str] = (),
        observers: Sequence[Observer] = (),
        bonds: Sequence[Bond] = (),
    ) -> None:
        self._choices = Choices(
            system=system,
            settings=settings,
            algorithm=algorithm or settings.make_algorithm(),
            controller=controller,
            events=tuple(events),
            observers=tuple(observers),
            bonds=tuple(bonds),
        )
        for path in events:
            system.find(path)

    def run(self, start_time: float, stop_time: float) -> Outcome:
        """Simulate from `start_time` to `stop_time` [s].

        All participants are freed at the end, whatever happens.

        Returns
        -------
        Outcome
            Also when the run was interrupted or a budget was used up.

        Raises
        ------
        InputError
            When system and settings do not fit together.
        RunError
            When the run cannot go on; it says how far it came.
        """
        began = perf_counter()
        prepared = prepare(self._choices, start_time, stop_time)
        loop, warnings = prepared.loop, list[str]()

        def end(reason: StopReason, failure: str = "") -> Outcome:
            return _outcome(
                prepared, reason, failure, warnings=warnings, wall_time=perf_counter() - began
            )

        with deferred_interrupt() as interrupt, ExitStack() as cleanup:
            warnings += self._initialise(prepared, stop_time, cleanup)
            first = prepared.clock.plan(prepared.controller.first_step)
            if loop.rolls_back and self._choices.settings.check_rollback:
                warnings += check_rollback(loop.saved, first.start, first.size)
            if not prepared.coupling.iterates:
                warnings += self._review_loops(prepared, first)
            try:
                reason = self._observe_loop(prepared, interrupt)
            except RunError as error:
                error.outcome = end(StopReason.FAILED, str(error))
                error.last_attempt = loop.last_attempt()
                raise
        return end(reason)

    def repeat(self, start_time: float, stop_time: float, attempt: LastAttempt) -> str | None:
        """Repeat the attempt on which a run from `start_time` to `stop_time` [s] ended.

        Returns
        -------
        str or None
            Why it failed, a clause that the error of the run holds too; None if it did not fail.

        Raises
        ------
        RunError
            When a participant died in it, or cannot be brought to its start.
        """
        prepared = prepare(self._choices, start_time, stop_time)
        with ExitStack() as cleanup:
            self._initialise(prepared, stop_time, cleanup)
            return prepared.loop.repeat(attempt)

    def _review_loops(self, prepared: Prepared, first: Step) -> list[str]:
        """Refuse an explicit algorithm where a loop is too strong for it; return what is in doubt.

        A run that saves no states needs them here, so that they are checked first.
        """
        warnings: list[str] = []
        exchange, blocks = prepared.exchange, prepared.blocks
        if not prepared.loop.rolls_back:
            if not self._choices.settings.check_rollback:
                return []
            coupled = {n for block in blocks if block.unknowns.size for n in block.order}
            stages = [exchange.stages[place] for place in sorted(coupled)]
            able = [stage for stage in stages if stage.participant.can_save_state]
            warnings += check_rollback(able, first.start, first.size)
        gains = estimate_loop_gains(exchange, blocks, first.start, first.size)
        extrapolates = self._choices.algorithm.uses_prediction
        doubts = review_loop_gains(gains, first.size, extrapolates=extrapolates)
        for doubt in doubts:
            logger.warning("%s", doubt)
        return warnings + doubts

    def _initialise(self, prepared: Prepared, stop_time: float, cleanup: ExitStack) -> list[str]:
        exchange, tolerance = prepared.exchange, self._choices.settings.tolerance
        for stage in exchange.stages:
            cleanup.callback(stage.participant.free)
            cleanup.callback(stage.release)
            stage.participant.instantiate()
        for stage in exchange.stages:
            stage.participant.enter_initialisation(
                start_time=prepared.clock.time, stop_time=stop_time, tolerance=tolerance
            )
        warnings = settle_initial_values(exchange)
        for stage in exchange.stages:
            stage.participant.exit_initialisation()
            stage.read_outputs()
        return warnings

    def _observe_loop(self, prepared: Prepared, interrupt: Interrupt) -> StopReason:
        exchange, loop, observers = prepared.exchange, prepared.loop, self._choices.observers
        for observer in observers:
            observer.start(exchange.observed_variables, loop.log)
        try:
            reason = loop.run(interrupt)
            for stage in exchange.stages:
                stage.participant.terminate()
        except KeyboardInterrupt:
            # It came in the middle of a call: participants are freed, but not spoken to any more.
            reason = StopReason.INTERRUPTED
        finally:
            for observer in observers:
                observer.finished()
        logger.info("the run ended, because %s", reason.value)
        return reason


def _outcome(
    prepared: Prepared, reason: StopReason, failure: str, *, warnings: list[str], wall_time: float
) -> Outcome:
    loop, ledger = prepared.loop, prepared.ledger
    found = prepared.switches.found
    return Outcome(
        end_time=prepared.clock.time,
        reason=reason,
        statistics=loop.log.statistics(len(found)),
        step_log=loop.log.as_array(),
        switches=tuple(found),
        wall_time=wall_time,
        warnings=(
            *warnings,
            *loop.watch.warnings(),
            *(loop.audit.warnings() if loop.audit else ()),
            *(ledger.warnings() if ledger else ()),
        ),
        unreliable=tuple(prepared.coupling.unreliable),
        failure=failure,
        audit=loop.audit.report() if loop.audit else None,
        bonds=ledger.reports() if ledger else (),
    )
