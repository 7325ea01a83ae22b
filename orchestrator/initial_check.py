"""Whether initial values depend on nothing but what the participants declare."""

from collections.abc import Collection, Iterable

import numpy as np

from .errors import InitialisationError
from .exchange import Exchange, Wire
from .initial_graph import Needs

settled = 1e-10
"""Difference over the nominal value at which initial values agree."""

repeatable = 1e-7
"""Change that is passed over, over the nominal value or the value itself if that is larger.

Solvers within a participant repeat themselves to less.
"""


def find_changes(exchange: Exchange, needs: Needs, torn: Collection[Wire]) -> dict[int, list[str]]:
    """Set all inputs to what has settled and look for outputs that do not stay what they were.

    An input that agrees with its output already is left alone.

    Parameters
    ----------
    exchange : Exchange
        The flat arrays, with the values settled.
    needs : sequence of sequence of Wire
        What every value was held to depend on.
    torn : collection of Wire
        Connections whose inputs hold torn values; they keep them.

    Returns
    -------
    dict of int to list of str
        Participants and their outputs that depend on something else, too. Those are left out that
        changed only because of others.

    Raises
    ------
    InitialisationError
        When a participant refuses, or an output is not finite.
    """
    inputs, outputs, places = exchange.inputs, exchange.outputs, exchange.value_places
    allowed = repeatable * np.maximum(exchange.nominal, np.abs(outputs[places]))
    # A value was handed on, and became another when its participant was asked for a later one.
    handed_on = {wire for wires in needs for wire in wires if wire not in torn}
    changed = {
        wire.value
        for wire in handed_on
        if not abs(outputs[wire.output] - inputs[wire.input]) <= allowed[wire.value]
    }
    if not changed:
        for wire in exchange.wires:
            apart = abs(outputs[wire.output] - inputs[wire.input])
            if wire not in torn and apart > settled * exchange.nominal[wire.value]:
                inputs[wire.input] = outputs[wire.output]
        before = outputs[places]
        for stage in exchange.stages:
            failure = stage.exchange()
            if failure is not None:
                reason = failure.message.rstrip(".")
                raise InitialisationError(f"The initial values do not settle: {reason}.")
        late = np.flatnonzero(~(np.abs(outputs[places] - before) <= allowed))
        changed = set(late.tolist())
    first = {v for v in changed if not any(wire.value in changed for wire in needs[v])}
    return _by_participant(exchange, sorted(first or changed))


def _by_participant(exchange: Exchange, values: Iterable[int]) -> dict[int, list[str]]:
    sources = {wire.value: wire.source_stage for wire in exchange.wires}
    found: dict[int, list[str]] = {}
    for value in values:
        found.setdefault(sources[value], []).append(exchange.value_names[value])
    return found
