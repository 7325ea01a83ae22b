"""What the iteration keeps from attempt to attempt."""

import numpy as np
import pytest

from orchestrator.newton import NewtonCoupling, fixed_point, most_step_sizes


class Loop:
    """A block that computes exp(-z) for one torn value z."""

    unknowns = np.array([0])
    guess = None
    names = ("z",)
    nominal, lower, upper = np.ones(1), np.full(1, -np.inf), np.full(1, np.inf)

    def __init__(self):
        self.seen = []

    def step(self, values, _time, _step_size):
        self.seen.append(values[0])

    def computed(self):
        return np.exp(-np.array(self.seen[-1:]))


@pytest.fixture
def loop():
    return Loop()


@pytest.fixture
def coupling(loop):
    return NewtonCoupling([(loop, fixed_point(loop, 1e-12, 20))])


def attempt(loop, coupling, guess=0.5, step_size=1.0):
    loop.seen.clear()
    result = coupling.attempt(0.0, step_size, np.zeros(1), np.array([guess]))
    assert result.failure is None
    assert result.iterations == len(loop.seen)
    assert loop.seen[-1] == pytest.approx(0.5671432904097838, abs=1e-12)
    return list(loop.seen)


def test_an_attempt_that_is_not_committed_repeats_itself_bit_for_bit(loop, coupling):
    attempt(loop, coupling, 0.4)
    coupling.commit()
    first = attempt(loop, coupling)
    assert attempt(loop, coupling) == first
    coupling.commit()
    assert attempt(loop, coupling) != first


def test_what_is_committed_saves_iterations_until_it_is_forgotten(loop, coupling):
    without = attempt(loop, coupling)
    coupling.commit()
    assert len(attempt(loop, coupling)) < len(without)
    coupling.forget()
    assert attempt(loop, coupling) == without


def test_every_step_size_has_a_jacobian_of_its_own(loop, coupling):
    attempt(loop, coupling, 0.4)
    coupling.commit()
    kept = attempt(loop, coupling)
    # Another size starts from what was learned last, and what it learns is its own.
    assert attempt(loop, coupling, step_size=2.0) == kept
    coupling.commit()
    assert attempt(loop, coupling, step_size=2.0) != kept
    assert attempt(loop, coupling) == kept


def test_jacobians_are_kept_for_a_bounded_number_of_step_sizes():
    coupling = NewtonCoupling([])
    for n in range(1, 2000):
        coupling.attempt(0.0, 1.0 / n, np.empty(0), np.empty(0))
        coupling.commit()
    assert len(coupling._by_step_size) == most_step_sizes
    assert 1.0 / 1999 in coupling._by_step_size
