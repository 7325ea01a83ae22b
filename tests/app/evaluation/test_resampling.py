import numpy as np
import pytest

from railcosim.errors import InputError
from railcosim.evaluation.resampling import resample

RATE = 6000.0
SETTLED = slice(60, -60)  # samples that the ends of the record do not touch
PASSED = 1e-3  # ripple of the filter, and the mean over a cell of the finer grid
STOPPED = 1e-4  # 80 dB


def recorded(frequency, seconds=0.1, step=2e-6):
    times = np.arange(0.0, seconds, step)
    return times, np.sin(2.0 * np.pi * frequency * times)


@pytest.mark.parametrize("frequency", [30.0, 1000.0, 2350.0])
def test_what_the_grid_can_show_passes_without_delay(frequency):
    samples = resample(*recorded(frequency), RATE)
    exact = np.sin(2.0 * np.pi * frequency * samples.x)
    np.testing.assert_allclose(samples.values[SETTLED], exact[SETTLED], rtol=0.0, atol=PASSED)


@pytest.mark.parametrize("frequency", [3010.0, 3500.0, 5900.0, 6000.0, 11_000.0, 50_000.0])
def test_a_tone_above_half_the_rate_vanishes(frequency):
    samples = resample(*recorded(frequency), RATE)
    assert np.abs(samples.values[SETTLED]).max() < STOPPED


def test_plain_sampling_would_have_folded_it_back():
    times, tone = recorded(3500.0)
    samples = resample(times, tone, RATE)
    folded = np.interp(samples.x, times, tone)
    assert np.abs(folded[SETTLED]).max() > 0.9


def test_a_straight_line_stays_one_whatever_the_steps():
    times = np.sort(np.random.default_rng(1).uniform(0.0, 0.1, 500))
    samples = resample(times, 1e5 + 3e4 * times, RATE)
    exact = 1e5 + 3e4 * samples.x
    np.testing.assert_allclose(samples.values[SETTLED], exact[SETTLED], rtol=1e-9)


def test_a_constant_stays_one_up_to_the_ends():
    times = np.array([0.0, 0.013, 0.1])
    samples = resample(times, np.full((3, 2), 1.2e5), RATE)
    assert samples.values.shape == (601, 2)
    np.testing.assert_array_equal(samples.values, 1.2e5)


def test_every_column_is_filtered_for_itself():
    times, tone = recorded(500.0)
    both = resample(times, np.column_stack((tone, 2.0 * tone)), RATE).values
    np.testing.assert_allclose(both[:, 1], 2.0 * both[:, 0], rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(both[:, 0], resample(times, tone, RATE).values, atol=1e-15)


def test_the_grid_starts_with_the_record_and_ends_in_its_last_sample():
    samples = resample(np.array([0.5, 0.6]), np.zeros(2), 50.0)
    np.testing.assert_allclose(samples.x, [0.5, 0.52, 0.54, 0.56, 0.58, 0.6], rtol=1e-12)


def test_the_limit_is_the_filters_or_the_records():
    fine, coarse = np.arange(0.0, 0.1, 1e-4), np.arange(0.0, 0.1, 1e-3)
    assert resample(fine, fine, RATE).limit == pytest.approx(2400.0)
    assert resample(coarse, coarse, RATE).limit == pytest.approx(500.0)


def test_a_record_shorter_than_a_sample_is_refused():
    with pytest.raises(InputError, match="shorter than one sample"):
        resample(np.array([0.0, 1e-4]), np.zeros(2), RATE)
