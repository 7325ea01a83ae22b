"""What the contact patch averages out: waves that are not much longer than it is."""

from __future__ import annotations

import numpy as np

from .spectra import FloatArray


def attenuation(wavenumber: FloatArray, semi_axis: float) -> FloatArray:
    r"""Return what is left of a wave in the contact, as a factor of its amplitude.

    .. math:: |H(W)| = \left(1 + \tfrac{\pi}{4} (W a)^3\right)^{-1/2}

    the usual simple form of the contact filter that P. J. Remington derived for a circular patch
    (Wheel/rail noise, part IV: rolling noise, Journal of Sound and Vibration 46, 1976); see
    D. J. Thompson, Railway Noise and Vibration (2009), chapter 5. It goes to one for long waves,
    and for short ones to the mean of Remington's (2 J_1(W a) / (W a))^2.

    Parameters
    ----------
    wavenumber : ndarray
        W [rad/m].
    semi_axis : float
        Half the length of the patch along the rail, a [m].
    """
    return 1.0 / np.sqrt(1.0 + 0.25 * np.pi * np.abs(wavenumber * semi_axis) ** 3)


def filter_around(drop: FloatArray, *, spacing: float, semi_axis: float) -> FloatArray:
    """Filter a signal that closes upon itself, as that of a tread.

    Parameters
    ----------
    drop : ndarray, shape (n,)
        One period at equal distances [m].
    spacing : float
        Distance of its points [m].
    semi_axis : float
        As for `attenuation`.

    Returns
    -------
    ndarray, shape (n,)
        The signal without delay.
    """
    wavenumber = np.asarray(2.0 * np.pi * np.fft.rfftfreq(drop.size, spacing), dtype=np.float64)
    lines = np.fft.rfft(drop) * attenuation(wavenumber, semi_axis)
    return np.fft.irfft(lines, drop.size)


def filter_along(drop: FloatArray, *, spacing: float, semi_axis: float) -> FloatArray:
    """Filter a signal with ends, as that of a rail; see `filter_around`.

    It is mirrored at both ends, so that it has no jump there.
    """
    mirrored = np.concatenate([drop, drop[::-1]])
    return filter_around(mirrored, spacing=spacing, semi_axis=semi_axis)[: drop.size]
