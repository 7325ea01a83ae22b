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

EN15610_LIMIT = (
    17.1, 15.0, 13.0, 11.0, 9.0, 7.0, 4.9, 2.9, 0.9, -1.1, -3.2, -5.0, -5.6, -6.2, -6.8, -7.4,
    -8.0, -8.6, -9.2, -9.8, -10.4, -11.0,
)  # fmt: skip
"""The limit as the program of EN 15610:2009, B.9.2, lists it, which is that of ISO 3095:2013."""


def variance(spectrum, low, high):
    return quad(lambda w: float(spectrum(np.array([w]))[0]), low, high, epsrel=1e-10)[0]


def test_the_bands_are_those_of_the_standard():
    assert len(NOMINAL) == len(ISO3095_LIMIT)
    # nominal wavelengths are rounded to 2 %
    assert 100.0 * band_wavelengths() == pytest.approx(np.array(NOMINAL), rel=0.02)
    low, high = band_edges(band_wavelengths())
    assert low[1:] == pytest.approx(high[:-1], rel=1e-14)


@pytest.mark.parametrize(("band", "level"), list(enumerate(EN15610_LIMIT)))
def test_the_limit_has_its_level_in_every_band(band, level):
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


FRA_CM2 = (1.2107, 1.0181, 0.6816, 0.5376, 0.2095, 0.0339)
"""Coefficients of classes 1 to 6 as they are printed [cm2 rad/m]."""


@pytest.mark.parametrize(
    ("track_class", "amplitude"),
    [(number, 1e-4 * printed) for number, printed in enumerate(FRA_CM2, start=1)],
)
def test_the_fra_spectrum_has_the_variance_of_its_partial_fractions(track_class, amplitude):
    cut = 0.8245

    def primitive(w):
        return 0.25 * amplitude * (-1.0 / w - np.arctan(w / cut) / cut)

    low, high = 2 * np.pi / 100.0, 2 * np.pi
    found = variance(fra(track_class), low, high)
    assert found == pytest.approx(primitive(high) - primitive(low), rel=1e-8)


@pytest.mark.parametrize(
    ("spectrum", "deviation"),
    [
        (german("low"), 0.98),
        (german("high"), 1.61),
        *((fra(k + 1), d) for k, d in enumerate((8.54, 7.83, 6.41, 5.69, 3.55, 1.43))),
    ],
)
def test_the_standard_deviations_that_the_documentation_gives(spectrum, deviation):
    """Of waves of 3 to 25 m, range D1 of EN 13848 [mm]."""
    found = variance(spectrum, 2 * np.pi / 25.0, 2 * np.pi / 3.0)
    assert 1e3 * found**0.5 == pytest.approx(deviation, abs=0.006)


def test_a_density_per_cycle_is_two_pi_times_one_per_radian():
    """Both have the same variance between the same wavelengths."""
    spectrum = fra(4)
    low, high = 2 * np.pi / 30.0, 2 * np.pi / 3.0
    cycles = quad(
        lambda n: 2 * np.pi * float(spectrum(np.array([2 * np.pi * n]))[0]), 1 / 30.0, 1 / 3.0
    )[0]
    assert cycles == pytest.approx(variance(spectrum, low, high), rel=1e-8)
