"""The spectra have the variances that their closed forms say."""

import numpy as np
import pytest
from scipy.integrate import quad

from railcosim.irregularity.spectra import (
    ISO3095_LIMIT,
    band_edges,
    band_wavelengths,
    fra,
    german,
    iso3095,
)

NOMINAL = (
    40, 31.5, 25, 20, 16, 12.5, 10, 8, 6.3, 5, 4, 3.15, 2.5, 2, 1.6, 1.25, 1, 0.8, 0.63, 0.5, 0.4,
    0.315,
)  # fmt: skip
"""Wavelengths of the bands as they are called [cm]."""


def variance(spectrum, low, high):
    return quad(lambda w: float(spectrum(np.array([w]))[0]), low, high, epsrel=1e-10)[0]


def test_the_bands_are_those_of_the_standard():
    assert len(NOMINAL) == len(ISO3095_LIMIT)
    # nominal wavelengths are rounded to 2 %
    assert 100.0 * band_wavelengths() == pytest.approx(np.array(NOMINAL), rel=0.02)
    low, high = band_edges(band_wavelengths())
    assert low[1:] == pytest.approx(high[:-1], rel=1e-14)


@pytest.mark.parametrize(("wavelength", "level"), [(0.4, 17.1), (0.1, 4.9), (0.01, -8.0)])
def test_the_limit_has_its_level_in_every_band(wavelength, level):
    band = int(np.argmin(abs(band_wavelengths() - wavelength)))
    low, high = (edges[band] for edges in band_edges(band_wavelengths()))
    inside = 1e-9 * (high - low)
    for extra in (0.0, 6.0):
        found = variance(iso3095(extra), low + inside, high - inside)
        assert 10.0 * np.log10(found / 1e-12) == pytest.approx(level + extra, abs=1e-6)


def test_there_is_nothing_outside_the_bands():
    low, high = band_edges(band_wavelengths())
    outside = iso3095()(np.array([0.99 * low[0], 1.01 * high[-1]]))
    assert outside.tolist() == [0.0, 0.0]


@pytest.mark.parametrize(("disturbance", "amplitude"), [("low", 4.032e-7), ("high", 1.080e-6)])
def test_the_german_spectrum_has_the_variance_of_its_partial_fractions(disturbance, amplitude):
    cut, bend = 0.8246, 0.0206

    def primitive(w):
        terms = np.arctan(w / bend) / bend - np.arctan(w / cut) / cut
        return amplitude * cut**2 / (cut**2 - bend**2) * terms

    low, high = 2 * np.pi / 100.0, 2 * np.pi
    found = variance(german(disturbance), low, high)
    assert found == pytest.approx(primitive(high) - primitive(low), rel=1e-8)


@pytest.mark.parametrize(("track_class", "amplitude"), [(1, 1.2107e-4), (5, 0.2095e-4)])
def test_the_fra_spectrum_has_the_variance_of_its_partial_fractions(track_class, amplitude):
    cut = 0.8245

    def primitive(w):
        return 0.25 * amplitude * (-1.0 / w - np.arctan(w / cut) / cut)

    low, high = 2 * np.pi / 100.0, 2 * np.pi
    found = variance(fra(track_class), low, high)
    assert found == pytest.approx(primitive(high) - primitive(low), rel=1e-8)


def test_a_density_per_cycle_is_two_pi_times_one_per_radian():
    """Both have the same variance between the same wavelengths."""
    spectrum = fra(4)
    low, high = 2 * np.pi / 30.0, 2 * np.pi / 3.0
    cycles = quad(
        lambda n: 2 * np.pi * float(spectrum(np.array([2 * np.pi * n]))[0]), 1 / 30.0, 1 / 3.0
    )[0]
    assert cycles == pytest.approx(variance(spectrum, low, high), rel=1e-8)
