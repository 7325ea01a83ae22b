"""Time is exact: on the grid, at the stop time, and in between."""

from fractions import Fraction
from types import MappingProxyType

import numpy as np
import pytest
from fake_participants import oscillators
from hypothesis import given
from hypothesis import strategies as some

from orchestrator import OK, Master, MasterSettings, SettingsError, System
from orchestrator.clock import Clock


class Quick:
    """A participant that costs nothing."""

    name = "quick"
    variables = MappingProxyType({})
    can_save_state = True
    can_serialise_state = False
    can_vary_step = True
    input_shape = "held"
    messages = ()

    def __getattr__(self, name):
        return lambda *_arguments, **_options: OK


class Times:
    def __init__(self):
        self.times = []

    def choose(self, _available):
        return []

    def start(self, _variables, _log):
        pass

    def accepted(self, time, _values):
        self.times.append(time)

    def finished(self):
        pass


def test_a_hundred_thousand_fixed_steps_hit_their_grid_to_the_last_bit():
    times = Times()
    settings = MasterSettings(tolerance=None, fixed_step=1e-5, algorithm="jacobi")
    outcome = Master(System([Quick()], []), settings, observers=[times]).run(0.3, 1.3)
    expected = 0.3 + np.arange(100_001) * 1e-5
    expected[-1] = 1.3
    assert np.array_equal(np.array(times.times), expected)
    assert set(outcome.step_log["step_size"]) == {1e-5}


def test_a_step_that_does_not_divide_the_run_is_cut_at_its_end():
    times = Times()
    settings = MasterSettings(tolerance=None, fixed_step=0.3, algorithm="jacobi")
    Master(System([Quick()], []), settings, observers=[times]).run(0.0, 1.0)
    assert times.times == [0.0, 0.3, 0.6, 3 * 0.3, 1.0]


def test_variable_steps_end_exactly_and_leave_no_sliver():
    settings = MasterSettings(tolerance=1e-3, max_step=0.01, min_step=1e-3, initial_step=5e-3)
    stop = 0.3333333
    outcome = Master(oscillators(kc=1.0), settings).run(0.0, stop)
    accepted = outcome.step_log[outcome.step_log["cause"] == 0]
    assert outcome.end_time == stop
    # What is left is halved rather than cut to a sliver: half the smallest step is the least.
    assert accepted["step_size"].min() >= 0.5e-3


@given(some.lists(some.floats(1e-9, 1e-3), min_size=1, max_size=300))
def test_the_sum_of_many_steps_is_correctly_rounded(sizes):
    clock = Clock(start=0.1, stop=1e6, min_step=1e-12)
    for size in sizes:
        clock.advance(clock.plan(size))
    exact = Fraction(0.1) + sum(map(Fraction, sizes))
    # Twice the working precision while summing: only the last rounding shows.
    assert clock.time == pytest.approx(float(exact), rel=2.0**-52, abs=0.0)


def test_an_off_grid_point_leads_back_to_the_grid():
    clock = Clock(start=0.0, stop=1.0, min_step=0.1, grid=0.1)
    clock.advance(clock.plan(0.1))
    clock.advance(clock.plan_exactly(0.03))
    assert clock.time == pytest.approx(0.13, abs=1e-16)
    clock.advance(clock.plan(0.1))
    assert clock.time == 0.2
    step = clock.plan(0.1)
    assert (step.size, step.landing) == (0.1, 3 * 0.1)


def test_a_rest_that_is_only_rounding_is_no_step():
    clock = Clock(start=0.0, stop=1.0, min_step=0.1, grid=0.1)
    clock.advance(clock.plan_exactly(0.1 - 1e-16))
    step = clock.plan(0.1)
    assert step.landing == 0.2
    assert step.size == pytest.approx(0.1, abs=2e-16)
    late = Clock(start=0.0, stop=1.0, min_step=1e-3)
    late.advance(late.plan_exactly(1.0 - 1e-15))
    assert late.finished
    assert late.time == 1.0


@pytest.mark.parametrize("stop", [1.0, 0.0, np.nan, np.inf])
@pytest.mark.parametrize("options", [{"tolerance": 1.0}, {"tolerance": None, "fixed_step": 0.1}])
def test_time_must_run_forwards(stop, options):
    master = Master(System([Quick()], []), MasterSettings(**options))
    with pytest.raises(SettingsError, match=rf"stop time {stop} s must be later than start time 1"):
        master.run(1.0, stop)
