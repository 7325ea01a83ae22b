"""Random signals that have a given spectrum."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from scipy.interpolate import CubicSpline

from .spectra import FloatArray, Spectrum

WAVES = 50
"""Shortest period of a signal in longest waves: some ten lines in the lowest one-third octave."""

POINTS_PER_WAVE = 16
"""Fewest points of a signal in its shortest wave: a cubic spline is then off by 1e-4 of it."""


def signal_points(*, shortest: float, longest: float, length: float) -> int:
    """Return how many points a signal of `random_profile` is made of, a power of two."""
    needed = POINTS_PER_WAVE * _period(longest, length) / shortest
    return 1 << math.ceil(math.log2(needed))


def _period(longest: float, length: float) -> float:
    return max(WAVES * longest, length)


def random_profile(
    spectrum: Spectrum, *, shortest: float, longest: float, length: float, seed: int
) -> Callable[[FloatArray], FloatArray]:
    """Return a random signal along the rail as a function of the position.

    Sines of the wavenumbers W_j = 2 pi j / period with amplitudes sqrt(2 S(W_j) dW) and phases
    from a generator of the given seed; nothing is shorter or longer than asked for. A line whose
    cell of width dW lies only partly within the limits gets that part of its variance. The signal
    depends on the arguments alone, not on where it is evaluated.

    Parameters
    ----------
    spectrum : Spectrum
        One-sided density S [m2/(rad/m)].
    shortest, longest : float
        Wavelengths between which it has waves [m].
    length : float
        Length from position zero on within which it does not repeat itself [m].
    seed : int
        Of the phases.

    Returns
    -------
    callable
        Signal [m] at positions [m], arrays of the same shape.
    """
    period = _period(longest, length)
    step = 2.0 * np.pi / period
    limits = 2.0 * np.pi / longest, 2.0 * np.pi / shortest
    line = np.arange(1, int(np.ceil(limits[1] / step)) + 1)
    wavenumber: FloatArray = step * line.astype(np.float64)
    upper = np.minimum(wavenumber + 0.5 * step, limits[1])
    width = np.clip(upper - np.maximum(wavenumber - 0.5 * step, limits[0]), 0.0, None)
    phase = np.random.default_rng(seed).uniform(0.0, 2.0 * np.pi, line.size)
    amplitude = np.sqrt(2.0 * spectrum(wavenumber) * width)

    points = signal_points(shortest=shortest, longest=longest, length=length)
    lines = np.zeros(points // 2 + 1, dtype=np.complex128)
    lines[line] = 0.5 * points * amplitude * np.exp(1j * phase)
    signal = np.fft.irfft(lines, points)
    x = period / points * np.arange(points + 1)
    curve = CubicSpline(x, np.append(signal, signal[0]), bc_type="periodic")
    return lambda position: np.asarray(curve(np.mod(position, period)), dtype=np.float64)
