"""Generated signals have the spectrum that was asked for, and nothing beside it."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.signal import welch

from railcosim.irregularity.spectra import ISO3095_LIMIT, band_edges, band_wavelengths, fra, iso3095
from railcosim.irregularity.synthesis import random_profile
from vehicle_fmu.interpolation import monotone_curve

ROUGHNESS = {"shortest": 0.01, "longest": 0.4, "length": 150.0}
TRACK = {"shortest": 1.0, "longest": 100.0, "length": 10_000.0}


def band_levels(signal, spacing, wavelengths):
    """Level of every one-third octave [dB re 1 um] by Welch's method, between lines by parts."""
    points = 1 << int(np.log2(signal.size / 2))
    frequency, density = welch(signal, 1.0 / spacing, "hann", points)
    step = frequency[1]
    edges = (np.asarray(band_edges(wavelengths)) / (2 * np.pi)).T
    shares = [
        np.clip(
            (np.minimum(frequency + step / 2, b) - np.maximum(frequency - step / 2, a)), 0, step
        )
        for a, b in edges
    ]
    return 10.0 * np.log10(np.array(shares) @ density / 1e-12)


def test_roughness_has_the_level_of_the_limit_in_every_band():
    """By Welch's method from 150 m: 0.5 dB for some hundred independent lines a band."""
    x = np.arange(0.0, 150.0, 0.002)
    profile = random_profile(iso3095(), **ROUGHNESS, seed=1)
    bands = band_wavelengths()[1:-6]  # without those at the ends of the signal's own spectrum
    found = band_levels(profile(x), 0.002, bands)
    assert found == pytest.approx(np.array(ISO3095_LIMIT)[1:-6], abs=0.5)


def test_a_track_has_the_variance_of_its_spectrum_in_every_octave():
    x = np.arange(0.0, 10_000.0, 0.25)
    signal = random_profile(fra(5), **TRACK, seed=2)(x)
    frequency, density = welch(signal, 4.0, "hann", 8192)
    for longest in (64.0, 32.0, 16.0, 8.0, 4.0):
        inside = (frequency >= 1 / longest) & (frequency < 2 / longest)
        found = density[inside].sum() * frequency[1]
        expected = quad(
            lambda w: float(fra(5)(np.array([w]))[0]), 2 * np.pi / longest, 4 * np.pi / longest
        )[0]
        # the number of independent estimates in an octave of 64 m is some 300: 6 %
        assert found == pytest.approx(expected, rel=0.1)


def test_the_variance_is_that_of_the_spectrum_to_the_last_line():
    """Over a whole period the lines are orthogonal, and parts of lines at the limits count."""
    period = 50 * 100.0
    x = np.linspace(0.0, period, 1 << 16, endpoint=False)
    signal = random_profile(fra(3), shortest=1.0, longest=100.0, length=period, seed=3)(x)
    expected = quad(
        lambda w: float(fra(3)(np.array([w]))[0]), 2 * np.pi / 100.0, 2 * np.pi, limit=200
    )[0]
    # the density falls by 1 / W^2 over the lowest line, 1 / 50 wide: 1e-3 of the variance
    assert np.mean(signal**2) == pytest.approx(expected, rel=2e-3)
    assert np.mean(signal) == pytest.approx(0.0, abs=1e-3 * np.sqrt(expected))


def test_no_wave_is_shorter_or_longer_than_asked_for():
    period = 50 * 0.4
    x = np.linspace(0.0, period, 1 << 15, endpoint=False)
    signal = random_profile(iso3095(), shortest=0.01, longest=0.4, length=1.0, seed=4)(x)
    wavenumber = np.arange(x.size // 2 + 1) / period
    power = abs(np.fft.rfft(signal)) ** 2
    outside = (wavenumber < 0.98 / 0.4) | (wavenumber > 1.02 / 0.01)
    # what a spline through 16 points a wave leaves
    assert power[outside].sum() < 1e-7 * power.sum()


def test_what_the_models_make_of_a_table_keeps_the_spectrum():
    """Their monotone curves flatten crests: 0.3 dB at ten points a wave, and little else."""
    spacing = 0.01 / 10
    x = np.arange(0.0, 21.0, spacing)
    profile = random_profile(iso3095(), **ROUGHNESS, seed=5)
    curve = monotone_curve(x, profile(x))
    fine = np.arange(0.5, 20.5, spacing / 4)
    rebuilt = np.array([curve(p) for p in fine.tolist()])
    bands = band_wavelengths()[1:-6]
    # 1.25 cm is the shortest of these bands
    change = band_levels(rebuilt, spacing / 4, bands) - band_levels(
        profile(fine), spacing / 4, bands
    )
    assert (change > -0.35).all()
    assert (change < 0.1).all()
    short = band_levels(rebuilt, spacing / 4, np.array([0.0063, 0.004, 0.0025]))
    assert (short < ISO3095_LIMIT[-6] - 20.0).all()


def test_the_same_seed_is_the_same_rail_wherever_it_is_looked_at():
    one, other = (random_profile(fra(5), **TRACK, seed=7) for _ in range(2))
    x = np.linspace(100.0, 200.0, 77)
    assert one(x).tobytes() == other(x).tobytes()
    assert one(x[40:]).tobytes() == one(x)[40:].tobytes()
    assert abs(random_profile(fra(5), **TRACK, seed=8)(x) - one(x)).max() > 1e-4


def test_it_is_gaussian():
    """Sums of many sines of random phase: kurtosis 3, here of some 2000 independent values."""
    signal = random_profile(iso3095(), **ROUGHNESS, seed=9)(np.arange(0.0, 30.0, 0.002))
    assert np.mean(signal**4) / np.mean(signal**2) ** 2 == pytest.approx(3.0, abs=0.3)
