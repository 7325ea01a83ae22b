import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from railcosim.comparison.polyline import Polyline
from railcosim.comparison.shift import FARTHEST, mean_square, time_shift

T = 2.0
STRIKE = 0.05  # s, width of a wheel's strike, for 0.01 of a signal


def line(times, values, **options):
    return Polyline.through(np.asarray(times, dtype=float), np.asarray(values), **options)


def strike(times, late=0.0):
    return np.exp(-(((times - 1.0 - late) / STRIKE) ** 2))


def uneven(count, seed):
    """Times with steps between a tenth and twice their mean."""
    steps = np.random.default_rng(seed).uniform(0.1, 2.0, count)
    times = np.concatenate([[0.0], np.cumsum(steps)])
    return T * times / times[-1]


@settings(max_examples=25)
@example(lag=1e-114, seed=0)  # times that are one after rounding
@example(lag=1.1125369292536007e-308, seed=0)
@given(lag=st.floats(-0.15, 0.15), seed=st.integers(0, 99))
def test_a_shifted_signal_has_that_shift(lag, seed):
    """Of the same samples, shifted: what is left is the precision of the search, 0.03 us here."""
    times = uneven(400, seed)
    wide = np.concatenate([[-1.0], times, [T + 1.0]])
    original = line(wide, strike(wide))
    interval = (0.0, T)
    shift = time_shift(original.shifted(lag).cut(*interval), original.cut(*interval))
    assert shift == pytest.approx(lag, abs=1e-6)


@settings(max_examples=25)
@given(lag=st.floats(-0.02, 0.02), seeds=st.tuples(st.integers(0, 99), st.integers(0, 99)))
def test_the_shift_is_found_between_samples_of_different_times(lag, seeds):
    """Straight lines between 400 samples are off by 4 % of a step of 5 ms at most."""
    new, old = (uneven(400, seed) for seed in seeds)
    shift = time_shift(line(new, strike(new, lag)), line(old, strike(old)))
    assert shift == pytest.approx(lag, abs=2e-4)


def test_a_ramp_has_the_shift_that_its_drift_hides_from_correlation():
    times = np.linspace(0.0, T, 101)
    assert time_shift(line(times, 7.0 * (times - 0.01)), line(times, 7.0 * times)) == pytest.approx(
        0.01, abs=1e-5
    )


def test_a_step_has_the_shift_of_its_jump():
    late, early = ([0.0, at, at, T] for at in (1.003, 1.0))
    shift = time_shift(line(late, [0.0, 0.0, 1.0, 1.0]), line(early, [0.0, 0.0, 1.0, 1.0]))
    assert shift == pytest.approx(0.003, abs=1e-4)


def test_a_larger_signal_is_not_later():
    times = uneven(400, 1)
    assert time_shift(line(times, 1.01 * strike(times)), line(times, strike(times))) == (
        pytest.approx(0.0, abs=1e-6)
    )


def test_no_lag_beyond_the_limit_is_found():
    times = np.linspace(0.0, T, 401)
    shift = time_shift(line(times, strike(times, 0.5)), line(times, strike(times)))
    assert abs(shift) <= FARTHEST * T


def test_a_signal_is_not_later_than_itself():
    times = uneven(50, 3)
    noise = np.random.default_rng(4).normal(size=times.size)
    assert time_shift(line(times, noise), line(times, noise)) == 0.0


@given(offset=st.floats(-5.0, 5.0), slope=st.floats(-5.0, 5.0), seed=st.integers(0, 99))
def test_the_mean_square_of_a_straight_difference_is_exact(offset, slope, seed):
    """The integral of (offset + slope t)^2 over T, whatever the times."""
    new, old = uneven(30, seed), uneven(17, seed + 1)
    noise = np.random.default_rng(seed).normal(size=old.size)
    other = line(old, noise)
    times = np.union1d(new, old)
    result = line(times, other.at(times)[1] + offset + slope * times)
    exact = offset**2 + offset * slope * T + slope**2 * T**2 / 3.0
    assert mean_square(result, other) == pytest.approx(exact, rel=1e-9, abs=1e-20)
