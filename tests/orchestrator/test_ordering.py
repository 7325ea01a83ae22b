"""Blocks that depend on each other in a circle, against SciPy's strong components."""

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from orchestrator.ordering import coupled_blocks


@pytest.mark.parametrize("density", [0.3, 1.0, 2.0])
def test_blocks_are_the_strong_components_upstream_first(density):
    rng = np.random.default_rng(7)
    for count in (1, 2, 5, 20, 60):
        for _ in range(20):
            ends = rng.integers(0, count, size=(2, int(density * count)))
            links = [(int(a), "y", int(b)) for a, b in ends.T]
            blocks = coupled_blocks(count, links)
            graph = coo_array((np.ones(ends.shape[1]), tuple(ends)), shape=(count, count))
            _, labels = connected_components(graph, connection="strong")
            assert {frozenset(block) for block in blocks} == {
                frozenset(np.flatnonzero(labels == label).tolist()) for label in set(labels)
            }
            order = {place: n for n, block in enumerate(blocks) for place in block}
            assert all(order[a] <= order[b] for a, _, b in links)


def test_a_long_chain_needs_no_deep_recursion():
    count = 20_000
    chain = [(place, "y", place + 1) for place in range(count - 1)]
    assert coupled_blocks(count, chain) == [[place] for place in range(count)]
    assert coupled_blocks(count, [*chain, (count - 1, "y", 0)]) == [list(range(count))]
