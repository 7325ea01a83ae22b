import numpy as np
import pytest

from railcosim.errors import InputError
from railcosim.evaluation.resampling import resample
from railcosim.evaluation.settings import Evaluation
from railcosim.evaluation.third_octaves import (
    edges,
    midband,
    nominal,
    third_octaves,
    wavelength_bands,
)

SPEED = 40.0 / 3.6
PASSED = 1e-3  # ripple of the resampling

# IEC 61260-1, table E.1: exact midband frequencies to base 10 and what they are called
TABLE = {
    15: (31.623, 31.5),
    20: (100.0, 100.0),
    23: (199.53, 200.0),
    27: (501.19, 500.0),
    30: (1000.0, 1000.0),
    31: (1258.9, 1250.0),
    32: (1584.9, 1600.0),
    35: (3162.3, 3150.0),
}


def test_the_bands_are_those_of_the_standard():
    numbers = np.array(list(TABLE))
    exact, names = zip(*TABLE.values(), strict=True)
    np.testing.assert_allclose(midband(numbers), exact, rtol=5e-5)
    assert nominal(numbers).tolist() == list(names)
    assert nominal(np.array([-25])).tolist() == [0.00315]
    # an octave of three bands is 10^0.3, and the edges lie in the geometric middle
    ends = edges(np.array([29, 30]))
    np.testing.assert_allclose(ends, 1000.0 * 10.0 ** np.array([-0.15, -0.05, 0.05]), rtol=1e-12)


def test_a_sine_gives_its_band_and_no_other(record, tone):
    found = third_octaves(record(tone(2e4, 500.0)))["contact_force_band"].sel(wheel=1)
    assert float(found.sel(band_frequency=500.0, method="nearest")) == pytest.approx(
        2e4 / np.sqrt(2.0), rel=2 * PASSED
    )
    others = found.where(np.abs(found["band_frequency"] - 501.2) > 1.0, drop=True)
    assert others.max() < 0.02 * 2e4


def test_the_squares_of_the_bands_add_up_to_the_mean_square(record):
    """Parseval: within the bands' range there is nothing else."""
    rng = np.random.default_rng(3)
    frequencies = rng.uniform(60.0, 1500.0, 40)
    phases, amplitudes = rng.uniform(0.0, 6.28, 40), rng.uniform(100.0, 1000.0, 40)
    passage = record(
        lambda t: (
            1e5 + amplitudes @ np.sin(2.0 * np.pi * np.outer(frequencies, t) + phases[:, None])
        )
    )
    bands = third_octaves(passage)["contact_force_band"].sel(wheel=1)
    force = passage["contact_force"].sel(wheel=1).to_numpy()
    samples = resample(passage["time"].to_numpy(), force, 6000.0).values
    assert float((bands**2).sum()) == pytest.approx(samples.var(), rel=5e-3)


def test_white_noise_rises_by_three_decibels_an_octave(record):
    """Its power is the density ``2 sigma2 h`` times the width of the band."""
    noise = np.random.default_rng(4).normal(0.0, 1e4, 80_001)
    passage = record(lambda _: 1e5 + noise, seconds=1.6)
    bands = third_octaves(passage)["contact_force_band"].sel(wheel=1)
    width = bands["band_frequency"] * (10.0**0.05 - 10.0**-0.05)
    exact = np.sqrt(2.0 * 1e4**2 * 20e-6 * width)
    spread = 0.5 / np.sqrt(1.6 * width)  # of an effective value from so many lines
    assert (np.abs(bands / exact - 1.0) < 4.5 * spread + 0.01).all()


def test_bands_reach_from_what_the_run_resolves_to_what_the_samples_show(record, tone):
    found = third_octaves(record(tone(1.0, 100.0)))
    names = found["nominal_frequency"].to_numpy()
    assert names[[0, -1]].tolist() == [31.5, 2000.0]  # 2 Hz between lines, 2400 Hz


def test_a_corrugation_gives_its_wavelength_at_any_speed(record, tone):
    """A wavelength of 80 mm is 139 Hz at 40 km/h; here 80 of them."""
    found = wavelength_bands(record(tone(1e4, SPEED / 0.08), seconds=0.576))
    bands = found["contact_force_wavelength_band"].sel(wheel=1)
    largest = bands.idxmax("band_wavelength")
    assert float(largest) == pytest.approx(0.0794, abs=1e-4)
    assert float(found["nominal_wavelength"].sel(band_wavelength=largest)) == 0.08
    assert float(bands.max()) == pytest.approx(1e4 / np.sqrt(2.0), rel=2e-3)
    assert found.attrs["wavelength_limit"] == pytest.approx(SPEED / 2400.0)


def test_a_run_too_short_for_a_band_is_refused(record, tone):
    with pytest.raises(InputError, match="no one-third-octave band fits"):
        third_octaves(record(tone(1.0, 100.0), seconds=0.01), Evaluation(rate=100.0))
