"""Resonances in a receptance."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import minimize_scalar

if TYPE_CHECKING:
    from collections.abc import Callable

    from track_fmu.beam_element import FloatArray

PROMINENCE_DB = 3.0
"""How far a peak rises above its surroundings; ripples from the ends of the track stay below."""

SPACING = 0.005
"""Of the frequencies at which they are looked for, relative: a third of the narrowest width."""


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
    lowest: float, highest: float, amplitude: Callable[[FloatArray], FloatArray]
) -> list[Peak]:
    """Find the peaks that stand out by `PROMINENCE_DB`.

    Parameters
    ----------
    lowest, highest : float
        Where they are looked for [Hz].
    amplitude : callable
        Amplitude [m/N] at frequencies [Hz], (n,) float arrays.

    Returns
    -------
    list of Peak
        In the order of their frequency.
    """
    from scipy import signal  # noqa: PLC0415 - takes long to import and serves this command only

    count = math.ceil(math.log(highest / lowest) / SPACING)
    frequencies = np.geomspace(lowest, highest, max(count, 3))
    sampled = 20.0 * np.log10(amplitude(frequencies))
    places, _ = signal.find_peaks(sampled, prominence=PROMINENCE_DB)
    peaks = []
    for k in places:
        around = float(frequencies[k - 1]), float(frequencies[k + 1])
        found = minimize_scalar(
            lambda f: -float(amplitude(np.array([f]))[0]),
            bounds=around,
            method="bounded",
            options={"xatol": 1e-4 * (around[1] - around[0])},
        )
        peaks.append(Peak(frequency=float(found.x), amplitude=-float(found.fun)))
    return peaks
