"""The order in which participants step: coupled blocks, and the fewest torn values in each."""

from collections.abc import Mapping, Sequence
from graphlib import TopologicalSorter

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

Link = tuple[int, str, int]
"""Output `name` of one participant drives another: (source, name, target)."""

Driven = Mapping[int, dict[str, set[int]]]
"""For every participant of a block, which others of the block each of its outputs drives."""

largest_exact_block = 12
"""Blocks up to this size get the best order of all, larger ones a good one."""


def coupled_blocks(count: int, links: Sequence[Link]) -> list[list[int]]:
    """Group participants into blocks that depend on each other in a circle, upstream first.

    Parameters
    ----------
    count : int
        Number of participants.
    links : sequence of Link
        The connections.

    Returns
    -------
    list of list of int
        Blocks in an order in which each depends on earlier ones only.
    """
    sources = [source for source, _, _ in links]
    targets = [target for _, _, target in links]
    graph = coo_array((np.ones(len(links)), (sources, targets)), shape=(count, count))
    _, labels = connected_components(graph, directed=True, connection="strong")
    members: dict[int, list[int]] = {}
    for place in range(count):
        members.setdefault(int(labels[place]), []).append(place)
    sorter: TopologicalSorter[int] = TopologicalSorter(dict.fromkeys(members, ()))
    for source, _, target in links:
        if labels[source] != labels[target]:
            sorter.add(int(labels[target]), int(labels[source]))
    return [members[label] for label in sorter.static_order()]


def order_of_fewest_torn(block: Sequence[int], links: Sequence[Link]) -> list[int]:
    """Order a block so that the fewest outputs are needed before they are computed.

    An output is torn when a participant it drives steps no later than its own. How many become
    torn when a participant is placed depends on the set placed before it, not on its order, which
    makes the best order a shortest path over sets.

    Parameters
    ----------
    block : sequence of int
        Participants of one block.
    links : sequence of Link
        The connections of the system.

    Returns
    -------
    list of int
        `block` reordered; among equals the given order is kept.
    """
    driven: dict[int, dict[str, set[int]]] = {place: {} for place in block}
    for source, name, target in links:
        if source in driven and target in driven:
            driven[source].setdefault(name, set()).add(target)
    exact = len(block) <= largest_exact_block
    return (_best_order if exact else _greedy_order)(block, driven)


def _newly_torn(driven: Driven, place: int, before: frozenset[int]) -> int:
    placed = before | {place}
    return sum(1 for targets in driven[place].values() if targets & placed)


def _best_order(block: Sequence[int], driven: Driven) -> list[int]:
    best: dict[frozenset[int], tuple[int, list[int]]] = {frozenset(): (0, [])}
    for _ in block:
        longer: dict[frozenset[int], tuple[int, list[int]]] = {}
        for placed, (cost, order) in best.items():
            for place in block:
                if place not in placed:
                    total = cost + _newly_torn(driven, place, placed)
                    key = placed | {place}
                    if key not in longer or total < longer[key][0]:
                        longer[key] = (total, [*order, place])
        best = longer
    return best[frozenset(block)][1]


def _greedy_order(block: Sequence[int], driven: Driven) -> list[int]:
    order: list[int] = []
    while len(order) < len(block):
        before = frozenset(order)
        rest = [place for place in block if place not in before]
        order.append(min(rest, key=lambda place: _newly_torn(driven, place, before)))
    return order
