"""What a run is made of, put together before any participant is called."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

from .block import Block, tear
from .bond import Bond
from .clock import Clock
from .coupling import Algorithm, Coupling
from .errors import RollbackError, SettingsError, WiringError
from .events import Switches
from .exchange import Exchange
from .ledger import Ledger
from .loop import Loop
from .observers import Observer
from .rollback import place_without_rollback
from .settings import MasterSettings
from .step_control import StepController
from .system import System


@dataclass(frozen=True, slots=True, kw_only=True)
class Choices:
    """What the user of the master chose.

    Attributes
    ----------
    system : System
        Participants and connections.
    settings : MasterSettings
        Tolerances and limits.
    algorithm : Algorithm
        Coupling algorithm.
    controller : StepController or None
        Step controller in place of the one that the settings describe.
    events : tuple of str
        Indicators, as ``participant.variable``.
    observers : tuple of Observer
        Who sees the accepted points.
    bonds : tuple of Bond
        Pairs of connections whose energy is added up.
    """

    system: System
    settings: MasterSettings
    algorithm: Algorithm
    controller: StepController | None
    events: tuple[str, ...]
    observers: tuple[Observer, ...]
    bonds: tuple[Bond, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Prepared:
    """The parts of one run.

    Attributes
    ----------
    controller : StepController
        Decides on attempts.
    clock : Clock
        The accepted time.
    exchange : Exchange
        Participants and the values between them.
    switches : Switches
        Locates changes of side of the indicators.
    ledger : Ledger or None
        Adds up the energy of the bonds, if there are any.
    blocks : list of Block
        What is stepped together, upstream first, without what steps last.
    coupling : Coupling
        Finds the exchanged values of a step.
    loop : Loop
        The time loop over all of these.
    """

    controller: StepController
    clock: Clock
    exchange: Exchange
    switches: Switches
    ledger: Ledger | None
    blocks: list[Block]
    coupling: Coupling
    loop: Loop


def prepare(choices: Choices, start_time: float, stop_time: float) -> Prepared:
    """Put together a run from `start_time` to `stop_time` [s].

    Raises
    ------
    InputError
        When system and settings do not fit together.
    """
    settings, algorithm = choices.settings, choices.algorithm
    duration = stop_time - start_time
    if not 0.0 < duration < inf:
        raise SettingsError(
            f"stop time {stop_time} s must be later than start time {start_time} s, and finite."
        )
    controller = choices.controller or settings.make_controller(duration)
    clock = Clock(
        start=start_time, stop=stop_time, min_step=controller.min_step, grid=controller.grid
    )
    exchange = Exchange(
        choices.system,
        indicators=choices.events,
        observed=_observed(choices),
        input_shape=algorithm.input_shape,
    )
    switches = Switches(
        choices.events,
        tolerance=settings.event_tolerance,
        time_tolerance=settings.event_time_tolerance,
        limit=settings.max_switches,
        window=settings.switch_window or 1e-6 * duration,
        accumulation_share=settings.accumulation_share,
        stop_time=stop_time,
    )
    ledger = Ledger(exchange, choices.bonds) if choices.bonds else None
    blocks, last, rolls_back = _divide(choices, exchange, controller)
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
        observers=choices.observers,
        ledger=ledger,
        settings=settings,
    )
    return Prepared(
        controller=controller,
        clock=clock,
        exchange=exchange,
        switches=switches,
        ledger=ledger,
        blocks=blocks,
        coupling=coupling,
        loop=loop,
    )


def _observed(choices: Choices) -> list[str]:
    available = choices.system.variables()
    chosen: list[str] = []
    for observer in choices.observers:
        for path in observer.choose(available):
            _, variable = choices.system.find(path)
            if variable.type == "String":
                raise WiringError(f"{path} is a String; only numbers can be observed.")
            chosen.append(path)
    return chosen


def _divide(
    choices: Choices, exchange: Exchange, controller: StepController
) -> tuple[list[Block], Block | None, bool]:
    """Return the blocks, the one that steps last if there is one, and whether states are saved."""
    algorithm, participants = choices.algorithm, choices.system.participants
    everything, audited = algorithm.tears_everything, choices.settings.audit is not None
    blocks = tear(exchange, everything=everything, last=None)
    varies = controller.grid is None or controller.may_reject or bool(choices.events) or audited
    if varies:
        _check_steps_may_vary(choices.system)
    if not varies and not algorithm.couple(blocks).iterates:
        return blocks, None, False
    delay_allowed = algorithm.allows_delay and not controller.uses_error
    place = place_without_rollback(choices.system, delay_allowed=delay_allowed)
    if place is None:
        return blocks, None, True
    name = participants[place].name
    if audited:
        raise RollbackError(
            f"{name} cannot save its state, so that no step can be repeated for the audit; leave "
            "the setting audit out."
        )
    _check_indicators_are_not_of(name, choices.events)
    *blocks, last = tear(exchange, everything=everything, last=place)
    return blocks, last, True


def _check_steps_may_vary(system: System) -> None:
    for participant in system.participants:
        if not participant.can_vary_step:
            raise SettingsError(
                f"{participant.name} needs steps of one size; use fixed_step without min_step, "
                "without events and without an audit."
            )


def _check_indicators_are_not_of(name: str, events: Sequence[str]) -> None:
    for path in events:
        if path.partition(".")[0] == name:
            raise WiringError(
                f"{path} cannot be an event indicator: {name} cannot save its state, so its "
                "switches cannot be located."
            )
