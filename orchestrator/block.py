"""Blocks of participants that step together, and the values torn to make that possible."""

from collections.abc import Sequence

import numpy as np

from .decision import Failure
from .exchange import Exchange, Wire
from .interface_jacobian import InterfaceJacobian, Link
from .ordering import coupled_blocks, order_of_fewest_torn
from .participant import Vector
from .quasi_newton import Guess
from .stage import Indices


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
    guess : callable or None
        Returns the inverse Jacobian that the directional derivatives of the participants lead to,
        if they give them.
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
        direct = {
            place: [w for w in exchange.wires if w.target_stage == place and w not in torn]
            for place in self.order
        }
        self._plan = [(exchange.stages[place], *_places(wires)) for place, wires in direct.items()]
        ends = np.cumsum([0, *(stage.outputs.size for stage in exchange.stages)])
        jacobian = InterfaceJacobian(
            exchange,
            unknowns=self.unknowns,
            torn=torn,
            chain=[
                Link(place, wires, np.arange(ends[place], ends[place + 1], dtype=np.intp))
                for place, wires in direct.items()
            ],
            declared=lambda participant: participant.dependencies,
        )
        self.guess: Guess | None = jacobian.inverse if jacobian.available else None

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

    def computed(self) -> Vector:
        """Return what has been computed for the torn values, shape (n,)."""
        return self._outputs[self._sources]


def _places(wires: Sequence[Wire]) -> tuple[Indices | None, Indices | None]:
    if not wires:
        return None, None
    return (
        np.array([wire.input for wire in wires], np.intp),
        np.array([wire.output for wire in wires], np.intp),
    )


def _memory_first(exchange: Exchange, group: Sequence[int]) -> list[int]:
    """Put those first whose outputs answer through their states only.

    An input that is only expected spoils the outputs of the others at once.
    """

    def passes_on(place: int) -> bool:
        stage = exchange.stages[place]
        return stage.passes_on(stage.participant.dependencies)

    return sorted(group, key=passes_on)


def tear(exchange: Exchange, *, everything: bool, last: int | None) -> list[Block]:
    """Divide the system into blocks.

    A step is one call that takes all inputs and gives all outputs, and what an output owes to an
    input through states is not declared: participants are coupled as a whole.

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
        order = order_of_fewest_torn(_memory_first(exchange, group), links)
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
