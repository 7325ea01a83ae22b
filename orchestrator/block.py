"""Blocks of participants that step together, and the values torn to make that possible."""

from collections.abc import Sequence

import numpy as np

from .decision import Failure
from .exchange import Exchange, Indices, Wire
from .ordering import coupled_blocks, order_of_fewest_torn
from .participant import Vector


class Block:
    """Participants in the order in which they step.

    Inputs that are torn take prescribed values; all others take what has just been computed.

    Parameters
    ----------
    exchange : Exchange
        The flat arrays.
    order : sequence of int
        Places of the participants.
    torn : sequence of Wire
        Connections whose inputs take prescribed values.

    Attributes
    ----------
    unknowns : numpy.ndarray of int, shape (n,)
        Places of the torn values among the exchanged values.
    names : tuple of str
        Their names.
    nominal, lower, upper : numpy.ndarray, shape (n,)
        Their scale and bounds.
    """

    def __init__(self, exchange: Exchange, order: Sequence[int], torn: Sequence[Wire]) -> None:
        self.order = tuple(order)
        self._inputs = exchange.inputs
        self._outputs = exchange.outputs
        values, places = np.unique([wire.value for wire in torn], return_inverse=True)
        self.unknowns: Indices = values.astype(np.intp)
        self.names = tuple(exchange.value_names[value] for value in self.unknowns)
        self.nominal: Vector = exchange.nominal[self.unknowns]
        self.lower: Vector = exchange.lower[self.unknowns]
        self.upper: Vector = exchange.upper[self.unknowns]
        self._sources: Indices = exchange.value_places[self.unknowns]
        self._torn_inputs: Indices = np.array([wire.input for wire in torn], np.intp)
        self._torn_values: Indices = places.astype(np.intp)
        self._plan = [
            (exchange.stages[place], *_direct(exchange, place, torn)) for place in self.order
        ]

    def step(self, unknowns: Vector, time: float, step_size: float) -> Failure | None:
        """Step every participant from `time` by `step_size` [s] with the torn values `unknowns`."""
        inputs, outputs = self._inputs, self._outputs
        if self._torn_inputs.size:
            inputs[self._torn_inputs] = unknowns[self._torn_values]
        for stage, into, source in self._plan:
            if into is not None:
                inputs[into] = outputs[source]
            failure = stage.step(time, step_size)
            if failure is not None:
                return failure
        return None

    def exchange(self, unknowns: Vector) -> Failure | None:
        """Pass values through every participant without a step."""
        if self._torn_inputs.size:
            self._inputs[self._torn_inputs] = unknowns[self._torn_values]
        for stage, into, source in self._plan:
            if into is not None:
                self._inputs[into] = self._outputs[source]
            failure = stage.exchange()
            if failure is not None:
                return failure
        return None

    def computed(self) -> Vector:
        """Return what has been computed for the torn values, shape (n,)."""
        return self._outputs[self._sources]


def _direct(
    exchange: Exchange, place: int, torn: Sequence[Wire]
) -> tuple[Indices | None, Indices | None]:
    wires = [wire for wire in exchange.wires if wire.target_stage == place and wire not in torn]
    if not wires:
        return None, None
    return (
        np.array([wire.input for wire in wires], np.intp),
        np.array([wire.output for wire in wires], np.intp),
    )


def tear(exchange: Exchange, *, everything: bool, last: int | None) -> list[Block]:
    """Divide the system into blocks.

    Parameters
    ----------
    exchange : Exchange
        The flat arrays.
    everything : bool
        Tear every connection within a block (Jacobi), or as few values as possible.
    last : int, optional
        A participant that cannot go back: it steps after all others, in a block of its own at the
        end, and what it drives is torn.

    Returns
    -------
    list of Block
        Upstream first.
    """
    late = [wire for wire in exchange.wires if wire.source_stage == last]
    links = [
        (wire.source_stage, str(wire.value), wire.target_stage)
        for wire in exchange.wires
        if wire.source_stage != last
    ]
    groups = coupled_blocks(len(exchange.stages), links)
    groups.sort(key=lambda group: last in group)
    blocks = []
    for group in groups:
        order = order_of_fewest_torn(group, links)
        rank = {place: n for n, place in enumerate(order)}
        torn = [
            wire
            for wire in exchange.wires
            if wire.target_stage in rank
            and (
                wire in late
                or (
                    wire.source_stage in rank
                    and (everything or rank[wire.source_stage] >= rank[wire.target_stage])
                )
            )
        ]
        blocks.append(Block(exchange, order, torn))
    return blocks
