"""Which exchanged value depends on which before the first step, and passes that compute them."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .decision import Failure
from .exchange import Exchange, Wire
from .interface_jacobian import InterfaceJacobian, Link
from .ordering import coupled_blocks, order_of_fewest_torn
from .participant import Participant, Vector
from .stage import Indices

Needs = Sequence[Sequence[Wire]]
"""For every exchanged value the connections to the inputs that it depends on."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Group:
    """Values that are computed together.

    Attributes
    ----------
    order : tuple of int
        Places among the exchanged values; each is computed from earlier ones and torn ones.
    torn : tuple of int
        Those that are needed before they are computed, ascending.
    """

    order: tuple[int, ...]
    torn: tuple[int, ...]


def find_needs(exchange: Exchange, silent: Collection[int]) -> Needs:
    """Return what the values depend on during the initialisation.

    Parameters
    ----------
    exchange : Exchange
        The flat arrays.
    silent : collection of int
        Places of participants whose declarations do not count.
    """
    inputs = [path.partition(".")[2] for path in exchange.input_names]
    sources = {wire.value: wire.source_stage for wire in exchange.wires}
    needs = []
    for value, path in enumerate(exchange.value_names):
        place = sources[value]
        declared = exchange.stages[place].participant.initial_dependencies
        known = None if place in silent else declared[path.partition(".")[2]]
        needs.append(
            [
                wire
                for wire in exchange.wires
                if wire.target_stage == place and (known is None or inputs[wire.input] in known)
            ]
        )
    return needs


def group_values(needs: Needs) -> list[Group]:
    """Divide the values into loops and what lies between them, upstream first.

    Returns
    -------
    list of Group
        Every loop is a group with the fewest torn values.
    """
    links = [(wire.value, "", value) for value, wires in enumerate(needs) for wire in wires]
    direct: list[int] = []
    groups: list[Group] = []

    def close() -> None:
        if direct:
            groups.append(Group(order=tuple(direct), torn=()))
            direct.clear()

    for members in coupled_blocks(len(needs), links):
        order = order_of_fewest_torn(members, links)
        torn = torn_values(order, needs)
        if torn:
            close()
            groups.append(Group(order=tuple(order), torn=torn))
        else:
            direct.extend(order)
    close()
    return groups


def torn_values(order: Sequence[int], needs: Needs) -> tuple[int, ...]:
    """Return what is needed in `order` no later than it is computed, ascending."""
    rank = {value: n for n, value in enumerate(order)}
    late = {
        wire.value
        for value in order
        for wire in needs[value]
        if rank.get(wire.value, -1) >= rank[value]
    }
    return tuple(sorted(late))


def make_chain(exchange: Exchange, group: Group, needs: Needs) -> list[Link]:
    """Return the turns of the participants in which `group` is computed.

    Values of one participant that need the same number of turns before them share one.
    """
    sources = {wire.value: wire.source_stage for wire in exchange.wires}
    level: dict[int, int] = {}
    turns: dict[tuple[int, int], list[int]] = {}
    for value in group.order:
        before = [
            level[wire.value]
            for wire in needs[value]
            if wire.value in level and wire.value not in group.torn
        ]
        level[value] = 1 + max(before, default=-1)
        turns.setdefault((level[value], sources[value]), []).append(value)
    return [
        Link(
            place,
            list(
                dict.fromkeys(
                    wire
                    for value in values
                    for wire in needs[value]
                    if wire.value not in group.torn
                )
            ),
            exchange.value_places[values],
        )
        for (_, place), values in sorted(turns.items())
    ]


class Reading(NamedTuple):
    """A value when it was computed.

    Attributes
    ----------
    output : float
        What it was.
    inputs : numpy.ndarray
        What the inputs were that it was held to depend on.
    places : numpy.ndarray of int
        Their places in `Exchange.inputs`.
    """

    output: float
    inputs: Vector
    places: Indices


class InitialGroup:
    """A group of values and the participants that compute it.

    Parameters
    ----------
    exchange : Exchange
        The flat arrays.
    group : Group
        The values.
    needs : sequence of sequence of Wire
        What they depend on.

    Attributes
    ----------
    unknowns : numpy.ndarray of int, shape (n,)
        Places of the torn values among the exchanged values.
    torn : list of Wire
        Connections whose inputs take torn values.
    jacobian : InterfaceJacobian
        First guess of how the torn values answer to themselves.
    readings : dict of int to Reading
        The values of the group as they were computed last.
    """

    def __init__(self, exchange: Exchange, group: Group, needs: Needs) -> None:
        self._exchange = exchange
        self._chain = make_chain(exchange, group, needs)
        self.unknowns: Indices = np.array(group.torn, np.intp)
        self.torn = list(
            dict.fromkeys(
                wire for value in group.order for wire in needs[value] if wire.value in group.torn
            )
        )
        ends = np.cumsum([0, *(stage.outputs.size for stage in exchange.stages)])
        self._turns = [
            (
                exchange.stages[link.stage],
                np.array([wire.input for wire in link.wires], np.intp),
                np.array([wire.output for wire in link.wires], np.intp),
                link.outputs - ends[link.stage],
                self._values_at(link.outputs),
            )
            for link in self._chain
        ]
        self._needed = {
            value: np.array([wire.input for wire in needs[value]], np.intp) for value in group.order
        }
        self.readings: dict[int, Reading] = {}
        self.jacobian = InterfaceJacobian(
            exchange,
            unknowns=self.unknowns,
            torn=self.torn,
            chain=self._chain,
            declared=_initially,
        )

    def evaluate(self, values: Vector) -> Failure | None:
        """Compute the group for the torn values, shape (n,)."""
        inputs, outputs = self._exchange.inputs, self._exchange.outputs
        for wire in self.torn:
            inputs[wire.input] = values[np.searchsorted(self.unknowns, wire.value)]
        for stage, into, source, wanted, computed in self._turns:
            inputs[into] = outputs[source]
            failure = stage.exchange(wanted)
            if failure is not None:
                return failure
            for value, place in computed:
                needed = self._needed[value]
                self.readings[value] = Reading(float(outputs[place]), inputs[needed], needed)
        return None

    def _values_at(self, places: Indices) -> list[tuple[int, int]]:
        found = {int(place): value for value, place in enumerate(self._exchange.value_places)}
        return [(found[place], place) for place in places.tolist()]

    def computed(self) -> Vector:
        """Return what has been computed for the torn values, shape (n,)."""
        return self._exchange.outputs[self._exchange.value_places[self.unknowns]]


def _initially(participant: Participant) -> Mapping[str, frozenset[str] | None]:
    return participant.initial_dependencies
