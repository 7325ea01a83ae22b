"""Whether initial values depend on nothing but what the participants declare."""

from collections.abc import Collection, Iterable, Mapping

import numpy as np

from .errors import InitialisationError
from .exchange import Exchange, Wire
from .initial_graph import Reading

settled = 1e-10
"""Difference over the nominal value at which initial values agree."""

repeatable = 1e-7
"""Change that is passed over, over the nominal value or the value itself if that is larger.

Solvers within a participant repeat themselves to less.
"""


def find_changes(
    exchange: Exchange, readings: Mapping[int, Reading], torn: Collection[Wire]
) -> dict[int, list[str]]:
    """Set all inputs to what has settled and look for outputs that do not stay what they were.

    An input that agrees with its output already is left alone.

    Parameters
    ----------
    exchange : Exchange
        The flat arrays, with the values settled.
    readings : mapping of int to Reading
        Every value when it was computed.
    torn : collection of Wire
        Connections whose inputs hold torn values; they keep them.

    Returns
    -------
    dict of int to list of str
        Participants and their outputs that changed although nothing did that they were held to
        depend on.

    Raises
    ------
    InitialisationError
        When a participant refuses, or an output is not finite.
    """
    inputs, outputs, nominal = exchange.inputs, exchange.outputs, exchange.nominal
    for wire in exchange.wires:
        apart = abs(outputs[wire.output] - inputs[wire.input])
        if wire not in torn and not apart <= settled * nominal[wire.value]:
            inputs[wire.input] = outputs[wire.output]
    for stage in exchange.stages:
        failure = stage.exchange()
        if failure is not None:
            reason = failure.message.rstrip(".")
            raise InitialisationError(f"The initial values do not settle: {reason}.")
    allowed = np.zeros(inputs.size)
    for wire in exchange.wires:
        allowed[wire.input] = settled * nominal[wire.value]
    changed, unfounded = [], []
    for value, (output, before, places) in sorted(readings.items()):
        now = outputs[exchange.value_places[value]]
        if not abs(now - output) <= repeatable * max(nominal[value], abs(output)):
            changed.append(value)
            if (np.abs(inputs[places] - before) <= allowed[places]).all():
                unfounded.append(value)
    return _by_participant(exchange, unfounded or changed)


def _by_participant(exchange: Exchange, values: Iterable[int]) -> dict[int, list[str]]:
    sources = {wire.value: wire.source_stage for wire in exchange.wires}
    found: dict[int, list[str]] = {}
    for value in values:
        found.setdefault(sources[value], []).append(exchange.value_names[value])
    return found
