"""The order of things that depend on each other: coupled blocks, the fewest torn values in each.

Participants that step, or single values of which each is its only output.
"""

from collections.abc import Container, Mapping, Sequence
from graphlib import TopologicalSorter

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
    labels = _strong_components(count, links)
    members: dict[int, list[int]] = {}
    for place in range(count):
        members.setdefault(labels[place], []).append(place)
    sorter: TopologicalSorter[int] = TopologicalSorter(dict.fromkeys(members, ()))
    for source, _, target in links:
        if labels[source] != labels[target]:
            sorter.add(labels[target], labels[source])
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


def _strong_components(count: int, links: Sequence[Link]) -> list[int]:
    """Label every participant by the block it belongs to.

    Kosaraju's algorithm: in reverse order of finishing a search along the links, what can be
    reached against them and has no label yet is a block. SciPy has it, too, but loading that takes
    as long as the rest of the start of an isolated FMU.
    """
    along: list[list[int]] = [[] for _ in range(count)]
    against: list[list[int]] = [[] for _ in range(count)]
    for source, _, target in links:
        along[source].append(target)
        against[target].append(source)
    seen = [False] * count
    finished = [place for start in range(count) for place in _search(start, along, seen)]
    labels, seen = [0] * count, [False] * count
    for start in reversed(finished):
        for place in _search(start, against, seen):
            labels[place] = start
    return labels


def _search(start: int, following: Sequence[Sequence[int]], seen: list[bool]) -> list[int]:
    """Return what can be reached and was not seen, depth first, as it is finished."""
    if seen[start]:
        return []
    seen[start] = True
    finished, way = [], [(start, iter(following[start]))]
    while way:
        place, others = way[-1]
        unseen = next((other for other in others if not seen[other]), None)
        if unseen is None:
            finished.append(place)
            way.pop()
        else:
            seen[unseen] = True
            way.append((unseen, iter(following[unseen])))
    return finished


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
    """Tear the output that most depends on and that most depend on until no circle is left."""
    outputs = [(source, name) for source in block for name in driven[source]]
    after = {
        (source, name): {
            (target, other) for target in driven[source][name] for other in driven[target]
        }
        for source, name in outputs
    }
    before: dict[tuple[int, str], set[tuple[int, str]]] = {output: set() for output in outputs}
    for output, following in after.items():
        for other in following:
            before[other].add(output)
    untorn = set(outputs)
    while after:
        ends = [output for output in after if not (after[output] and before[output])]
        if ends:
            removed = ends
        else:
            worst = max(after, key=lambda output: len(after[output]) * len(before[output]))
            untorn.discard(worst)
            removed = [worst]
        for output in removed:
            for other in after.pop(output):
                before[other].discard(output)
            for other in before.pop(output):
                if other in after:
                    after[other].discard(output)
    return _order_along(block, driven, untorn)


def _order_along(
    block: Sequence[int], driven: Driven, untorn: Container[tuple[int, str]]
) -> list[int]:
    """Order `block` so that every output in `untorn` comes before what it drives."""
    waiting: dict[int, set[int]] = {place: set() for place in block}
    for source, outputs in driven.items():
        for name, targets in outputs.items():
            if (source, name) in untorn:
                for target in targets:
                    waiting[target].add(source)
    return list(TopologicalSorter(waiting).static_order())
