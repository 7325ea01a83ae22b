"""Initial values that agree on both ends of every connection."""

import logging

import numpy as np

from .decision import Failure
from .errors import InitialisationError, list_names
from .exchange import Exchange, Wire
from .initial_check import find_changes, settled
from .initial_graph import InitialGroup, Reading, find_needs, group_values
from .participant import Matrix
from .quasi_newton import FixedPoint

logger = logging.getLogger(__name__)

max_iterations = 100


def settle_initial_values(exchange: Exchange) -> list[str]:
    """Pass values through all participants, in initialisation mode, until nothing changes.

    What the outputs depend on is taken from the participants; one that does not say lets every
    output depend on every input. Values come in the order of their dependence, loops are solved for
    the fewest torn values. At last everything is computed once more: a participant whose outputs
    change then has declared too little, and counts as silent in a new beginning. All do if there is
    no settling otherwise.

    Parameters
    ----------
    exchange : Exchange
        The flat arrays.

    Returns
    -------
    list of str
        A sentence for every participant whose declarations are wrong.

    Raises
    ------
    InitialisationError
        When a loop does not settle or a participant refuses.
    """
    everyone = range(len(exchange.stages))
    silent: set[int] = set()
    warnings: list[str] = []
    while True:
        readings, torn, failure = _settle(exchange, silent)
        if failure is not None:
            reason = failure.message.rstrip(".")
            if find_needs(exchange, silent) == find_needs(exchange, everyone):
                raise InitialisationError(f"The initial values do not settle: {reason}.")
            logger.info("declared dependences are passed over, because %s", reason)
            silent.update(everyone)
            continue
        changed = find_changes(exchange, readings, torn)
        if not changed:
            return warnings
        wrong = {place: names for place, names in changed.items() if place not in silent}
        if not wrong:
            place, names = next(iter(changed.items()))
            raise InitialisationError(
                f"The initial values do not settle: {list_names(names)} of "
                f"{exchange.stages[place].participant.name} changed when it was computed once "
                "more from the same inputs."
            )
        for place, names in wrong.items():
            warnings.append(
                f"The initial value of {list_names(names)} depends on more inputs than "
                f"{exchange.stages[place].participant.name} declares: its declarations for the "
                "initialisation were passed over."
            )
            logger.warning("%s", warnings[-1])
        silent.update(wrong)


def _settle(
    exchange: Exchange, silent: set[int]
) -> tuple[dict[int, Reading], set[Wire], Failure | None]:
    """Settle group by group; return the values as computed and connections with torn values."""
    needs = find_needs(exchange, silent)
    _guess(exchange)
    readings: dict[int, Reading] = {}
    torn: set[Wire] = set()
    for members in group_values(needs):
        group = InitialGroup(exchange, members, needs)
        failure = _solve(exchange, group)
        if failure is not None:
            return readings, torn, failure
        readings.update(group.readings)
        torn.update(group.torn)
    return readings, torn, None


def _guess(exchange: Exchange) -> None:
    """Let the inputs be what the participants start with, or zero where that is not finite."""
    for stage in exchange.stages:
        stage.read_outputs()
    for wire in exchange.wires:
        value = exchange.outputs[wire.output]
        value = value if np.isfinite(value) else 0.0
        exchange.inputs[wire.input] = np.clip(
            value, exchange.lower[wire.value], exchange.upper[wire.value]
        )


def _solve(exchange: Exchange, group: InitialGroup) -> Failure | None:
    unknowns = group.unknowns
    if not unknowns.size:
        return group.evaluate(np.empty(0))
    # The first guess simply hands values on: what only looks like a loop settles so.
    hand_on: Matrix = -np.eye(unknowns.size)

    def guess() -> Matrix:
        found = group.jacobian.inverse() if group.jacobian.available else None
        return hand_on if found is None else found

    equations = FixedPoint(
        names=[exchange.value_names[value] for value in unknowns],
        nominal=exchange.nominal[unknowns],
        lower=exchange.lower[unknowns],
        upper=exchange.upper[unknowns],
        tolerance=settled,
        max_iterations=max_iterations,
    )
    inputs = {wire.value: wire.input for wire in group.torn}
    start = np.array([exchange.inputs[inputs[value]] for value in unknowns])
    return equations.solve(group.evaluate, group.computed, start, None, guess).failure
