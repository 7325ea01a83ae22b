"""The co-simulation master: sets a system up, runs it and cleans up."""

import logging
from collections.abc import Sequence
from contextlib import ExitStack
from math import inf
from time import perf_counter

from .block import Block, tear
from .bond import Bond
from .clock import Clock, Step
from .coupling import Algorithm, Coupling
from .errors import RollbackError, SettingsError, WiringError
from .events import Switches
from .exchange import Exchange
from .initialisation import settle_initial_values
from .interrupt import Interrupt, deferred_interrupt
from .ledger import Ledger
from .loop import Loop
from .loop_gain import estimate_loop_gains, review_loop_gains
from .observers import Observer
from .outcome import Outcome, StopReason
from .rollback import check_rollback, place_without_rollback
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
        self._system = system
        self._settings = settings
        self._algorithm = algorithm or settings.make_algorithm()
        self._controller = controller
        self._events = tuple(events)
        self._observers = tuple(observers)
        self._bonds = tuple(bonds)
        for path in self._events:
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
            When the run cannot go on.
        """
        began = perf_counter()
        duration = stop_time - start_time
        if not 0.0 < duration < inf:
            raise SettingsError(
                f"stop time {stop_time} s must be later than start time {start_time} s, and finite."
            )
        controller = self._controller or self._settings.make_controller(duration)
        clock = Clock(
            start=start_time, stop=stop_time, min_step=controller.min_step, grid=controller.grid
        )
        exchange = Exchange(
            self._system,
            indicators=self._events,
            observed=self._choose(),
            input_shape=self._algorithm.input_shape,
        )
        switches = self._make_switches(duration)
        ledger = Ledger(exchange, self._bonds) if self._bonds else None
        loop, blocks, coupling = self._make_loop(exchange, controller, clock, switches, ledger)
        warnings: list[str] = []
        with deferred_interrupt() as interrupt, ExitStack() as cleanup:
            self._initialise(exchange, clock, stop_time, cleanup)
            first = clock.plan(controller.first_step)
            if loop.rolls_back and self._settings.check_rollback:
                check_rollback(loop.saved, first.start, first.size)
            if not coupling.iterates:
                warnings += self._review_loops(loop, exchange, blocks, first)
            reason = self._observe_loop(loop, interrupt, exchange)
        return Outcome(
            end_time=clock.time,
            reason=reason,
            statistics=loop.log.statistics(len(switches.found)),
            step_log=loop.log.as_array(),
            switches=tuple(switches.found),
            wall_time=perf_counter() - began,
            warnings=(
                *warnings,
                *(loop.audit.warnings() if loop.audit else ()),
                *(ledger.warnings() if ledger else ()),
            ),
            unreliable=tuple(coupling.unreliable),
            audit=loop.audit.report() if loop.audit else None,
            bonds=ledger.reports() if ledger else (),
        )

    def _review_loops(
        self, loop: Loop, exchange: Exchange, blocks: list[Block], first: Step
    ) -> list[str]:
        """Refuse an explicit algorithm where a loop is too strong for it; return what is in doubt.

        A run that saves no states needs them here, so that they are checked first.
        """
        if not loop.rolls_back:
            if not self._settings.check_rollback:
                return []
            coupled = {n for block in blocks if block.unknowns.size for n in block.order}
            stages = [exchange.stages[place] for place in sorted(coupled)]
            able = [stage for stage in stages if stage.participant.can_save_state]
            check_rollback(able, first.start, first.size)
        gains = estimate_loop_gains(exchange, blocks, first.start, first.size)
        warnings = review_loop_gains(
            gains, first.size, extrapolates=self._algorithm.uses_prediction
        )
        for warning in warnings:
            logger.warning("%s", warning)
        return warnings

    def _choose(self) -> list[str]:
        available = self._system.variables()
        chosen: list[str] = []
        for observer in self._observers:
            for path in observer.choose(available):
                _, variable = self._system.find(path)
                if variable.type == "String":
                    raise WiringError(f"{path} is a String; only numbers can be observed.")
                chosen.append(path)
        return chosen

    def _make_switches(self, duration: float) -> Switches:
        settings = self._settings
        return Switches(
            self._events,
            tolerance=settings.event_tolerance,
            time_tolerance=settings.event_time_tolerance,
            limit=settings.max_switches,
            window=settings.switch_window or 1e-6 * duration,
        )

    def _make_loop(
        self,
        exchange: Exchange,
        controller: StepController,
        clock: Clock,
        switches: Switches,
        ledger: Ledger | None,
    ) -> tuple[Loop, list[Block], Coupling]:
        algorithm = self._algorithm
        blocks = tear(exchange, everything=algorithm.tears_everything, last=None)
        audited = self._settings.audit is not None
        varies = controller.grid is None or controller.may_reject or bool(self._events) or audited
        rolls_back = varies or algorithm.couple(blocks).iterates
        if varies:
            self._check_steps_may_vary()
        last = None
        if rolls_back:
            delay_allowed = algorithm.allows_delay and not controller.uses_error
            place = place_without_rollback(self._system, delay_allowed=delay_allowed)
            if place is not None:
                if audited:
                    raise RollbackError(
                        f"{self._system.participants[place].name} cannot save its state, so that "
                        "no step can be repeated for the audit; leave the setting audit out."
                    )
                self._check_indicators_are_not_of(self._system.participants[place].name)
                blocks = tear(exchange, everything=algorithm.tears_everything, last=place)
                last = blocks.pop()
        coupling = algorithm.couple(blocks)
        loop = Loop(
            exchange=exchange,
            coupling=coupling,
            controller=controller,
            switches=switches,
            clock=clock,
            last=last,
            rolls_back=rolls_back,
            predicts=algorithm.uses_prediction or controller.uses_error,
            observers=self._observers,
            ledger=ledger,
            settings=self._settings,
        )
        return loop, blocks, coupling

    def _check_steps_may_vary(self) -> None:
        for participant in self._system.participants:
            if not participant.can_vary_step:
                raise SettingsError(
                    f"{participant.name} needs steps of one size; use fixed_step without min_step "
                    "and without events."
                )

    def _check_indicators_are_not_of(self, name: str) -> None:
        for path in self._events:
            if path.partition(".")[0] == name:
                raise WiringError(
                    f"{path} cannot be an event indicator: {name} cannot save its state, so its "
                    "switches cannot be located."
                )

    def _initialise(
        self, exchange: Exchange, clock: Clock, stop_time: float, cleanup: ExitStack
    ) -> None:
        for stage in exchange.stages:
            cleanup.callback(stage.participant.free)
            cleanup.callback(stage.release)
            stage.participant.instantiate()
        for stage in exchange.stages:
            stage.participant.enter_initialisation(
                start_time=clock.time, stop_time=stop_time, tolerance=self._settings.tolerance
            )
        settle_initial_values(exchange)
        for stage in exchange.stages:
            stage.participant.exit_initialisation()
            stage.read_outputs()

    def _observe_loop(self, loop: Loop, interrupt: Interrupt, exchange: Exchange) -> StopReason:
        for observer in self._observers:
            observer.start(exchange.observed_variables, loop.log)
        try:
            reason = loop.run(interrupt)
            for stage in exchange.stages:
                stage.participant.terminate()
        except KeyboardInterrupt:
            # It came in the middle of a call: participants are freed, but not spoken to any more.
            reason = StopReason.INTERRUPTED
        finally:
            for observer in self._observers:
                observer.finished()
        logger.info("the run ended, because %s", reason.value)
        return reason
