"""Levels of a signal in one-third octaves of wavelength."""

from __future__ import annotations

import numpy as np

from .spectra import REFERENCE, FloatArray, band_edges

LINES_IN_A_BAND = 3
"""Fewest lines of a signal's own spectrum that make a band."""


def band_levels(drop: FloatArray, spacing: float) -> tuple[FloatArray, FloatArray]:
    """Return the r.m.s. levels of a signal along a rail [dB re 1 um].

    Its mean is taken off, and its ends are faded out by Hann's window, whose share of the mean
    square, 3 / 8, is made up for.

    Parameters
    ----------
    drop : ndarray, shape (n,)
        At equal distances [m].
    spacing : float
        Distance of its points [m].

    Returns
    -------
    wavelength : ndarray, shape (bands,)
        Exact centres 10^(k / 10) [m], longest first: those of which the signal has enough lines
        and points.
    level : ndarray, shape (bands,)
        -inf in a band without any roughness.
    """
    window = np.hanning(drop.size)
    lines = np.fft.rfft((drop - drop.mean()) * window)
    power = 2.0 * np.abs(lines / drop.size) ** 2 / np.mean(window**2)
    wavenumber = 2.0 * np.pi * np.fft.rfftfreq(drop.size, spacing)
    length = drop.size * spacing
    numbers = np.arange(np.floor(10.0 * np.log10(length)), 10.0 * np.log10(2.0 * spacing), -1.0)
    wavelength = np.asarray(10.0 ** (numbers / 10.0), dtype=np.float64)
    low, high = band_edges(wavelength)
    count = np.searchsorted(wavenumber, high) - np.searchsorted(wavenumber, low)
    whole = (count >= LINES_IN_A_BAND) & (high <= wavenumber[-1])
    sums = np.append(0.0, np.cumsum(power))
    band = sums[np.searchsorted(wavenumber, high)] - sums[np.searchsorted(wavenumber, low)]
    with np.errstate(divide="ignore"):
        level = 10.0 * np.log10(np.maximum(band, 0.0) / REFERENCE**2)
    return wavelength[whole], level[whole]
