"""Resonances in a receptance."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import minimize_scalar

if TYPE_CHECKING:
    from collections.abc import Callable

    from track_fmu.beam_element import FloatArray

PROMINENCE_DB = 3.0
"""How far a peak rises above its surroundings; ripples from the ends of the track stay below."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Peak:
    """A resonance.

    Attributes
    ----------
    frequency : float
        Where the amplitude is largest [Hz].
    amplitude : float
        Of the receptance there [m/N].
    """

    frequency: float
    amplitude: float


def find_peaks(
    frequencies: FloatArray, amplitude: FloatArray, evaluate: Callable[[float], float]
) -> list[Peak]:
    """Find the peaks that stand out by `PROMINENCE_DB`, between the sampled frequencies too.

    Parameters
    ----------
    frequencies, amplitude : (n,) float array
        Sampled receptance [Hz], [m/N].
    evaluate : callable
        Amplitude [m/N] at any frequency [Hz].

    Returns
    -------
    list of Peak
        In the order of their frequency.
    """
    from scipy import signal  # noqa: PLC0415 - takes long to import and serves this command only

    places, _ = signal.find_peaks(20.0 * np.log10(amplitude), prominence=PROMINENCE_DB)
    peaks = []
    for k in places:
        around = float(frequencies[k - 1]), float(frequencies[k + 1])
        found = minimize_scalar(
            lambda f: -evaluate(float(f)),
            bounds=around,
            method="bounded",
            options={"xatol": 1e-4 * (around[1] - around[0])},
        )
        peaks.append(Peak(frequency=float(found.x), amplitude=-float(found.fun)))
    return peaks
