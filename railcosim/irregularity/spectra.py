"""Spectra of vertical track irregularities and of rail roughness."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

FloatArray: TypeAlias = NDArray[np.float64]
Spectrum: TypeAlias = Callable[[FloatArray], FloatArray]
"""One-sided power spectral density S [m2/(rad/m)] over the angular wavenumber W [rad/m]."""

REFERENCE = 1e-6
"""Roughness of 0 dB, r.m.s. [m]."""

ISO3095_LIMIT = (
    17.1, 15.0, 13.0, 11.0, 9.0, 7.0, 4.9, 2.9, 0.9, -1.1, -3.2, -5.0, -5.6, -6.2, -6.8, -7.4,
    -8.0, -8.6, -9.2, -9.8, -10.4, -11.0,
)  # fmt: skip
"""Limit of rail roughness in one-third octaves of wavelength, 40 cm to 3.15 mm [dB re 1 um]."""

LONGEST_BAND = -4
"""The band of 40 cm, as a power of 10^(1/10) of its wavelength in metres: 10^(-0.4) = 0.398."""

GERMAN_AMPLITUDE = {"low": 4.032e-7, "high": 1.080e-6}
"""Roughness coefficient A of the German vertical spectra [m rad]."""

GERMAN_CUTOFF, GERMAN_BEND = 0.8246, 0.0206
"""Wavenumbers W_c and W_r of the German spectra [rad/m]."""

FRA_AMPLITUDE = (1.2107e-4, 1.0181e-4, 0.6816e-4, 0.5376e-4, 0.2095e-4, 0.0339e-4)
"""Roughness coefficient A of FRA track classes 1 to 6 [m2 rad/m]."""

FRA_CUTOFF, FRA_FACTOR = 0.8245, 0.25
"""Wavenumber W_c [rad/m] and factor of the FRA spectra."""


def band_wavelengths() -> FloatArray:
    """Return the exact centres of the bands of ISO 3095:2013 [m], shape (22,), falling."""
    numbers = LONGEST_BAND - np.arange(len(ISO3095_LIMIT))
    return np.asarray(10.0 ** (numbers / 10.0))


def band_edges(wavelength: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the lowest and highest wavenumber of one-third octaves of these centres [rad/m]."""
    centre = 2.0 * np.pi / wavelength
    return centre * 10.0**-0.05, centre * 10.0**0.05


def iso3095(level_db: float = 0.0) -> Spectrum:
    """Return the limit of ISO 3095:2013 for rail roughness, level in every band.

    Parameters
    ----------
    level_db : float
        Level above the limit, the same in all bands [dB].

    Returns
    -------
    Spectrum
        Constant within each one-third octave, whose r.m.s. is 1 um times 10^(L / 20); zero
        outside them all.
    """
    low, high = band_edges(band_wavelengths())
    variance = (REFERENCE * 10.0 ** ((np.array(ISO3095_LIMIT) + level_db) / 20.0)) ** 2
    density = np.concatenate([[0.0], variance / (high - low), [0.0]])
    edges = np.append(low, high[-1])

    def spectrum(wavenumber: FloatArray) -> FloatArray:
        return density[np.searchsorted(edges, wavenumber, side="right")]

    return spectrum


def german(disturbance: str) -> Spectrum:
    """Return the German vertical spectrum S = A Wc2 / ((W2 + Wr2) (W2 + Wc2)).

    Parameters
    ----------
    disturbance : {"low", "high"}
        Which of the two tracks, for which `GERMAN_AMPLITUDE` has A.
    """
    amplitude = GERMAN_AMPLITUDE[disturbance]
    cutoff2, bend2 = GERMAN_CUTOFF**2, GERMAN_BEND**2

    def spectrum(wavenumber: FloatArray) -> FloatArray:
        square = wavenumber**2
        return amplitude * cutoff2 / ((square + bend2) * (square + cutoff2))

    return spectrum


def fra(track_class: int) -> Spectrum:
    """Return the vertical spectrum S = 0.25 A Wc2 / (W2 (W2 + Wc2)) of an FRA track class.

    Parameters
    ----------
    track_class : {1, 2, 3, 4, 5, 6}
        6 is the smoothest track; `FRA_AMPLITUDE` has A.
    """
    amplitude = FRA_FACTOR * FRA_AMPLITUDE[track_class - 1]
    cutoff2 = FRA_CUTOFF**2

    def spectrum(wavenumber: FloatArray) -> FloatArray:
        square = wavenumber**2
        return amplitude * cutoff2 / (square * (square + cutoff2))

    return spectrum
