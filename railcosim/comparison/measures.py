"""How far apart two signals are, in numbers."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .shift import mean_square, time_shift

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .polyline import Polyline

CONSTANT = 1e-6
"""Range over magnitude below which a baseline counts as constant: what moves is rounding."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Measures:
    """How far a signal is from its baseline.

    Attributes
    ----------
    scale : float
        What relative numbers refer to: the range of the baseline, its magnitude where it is
        constant, 0 where it is 0 throughout [unit].
    nrms : float
        Root mean square of the difference over time, over the scale; infinite if that is 0 and
        the signals differ, as every relative number.
    nrms_aligned : float
        The same with the result taken earlier by `shift`.
    difference : float
        Difference of largest magnitude, result less baseline [unit].
    difference_time : float
        When that is [s].
    excess : float
        What is left of the largest difference where values may come earlier or later by the
        tolerance in time, either way: how high the tube has to be [unit].
    excess_time : float
        When that is [s].
    peak, baseline_peak : float
        Values of largest magnitude [unit].
    shift : float
        Lag of the result [s].
    """

    scale: float
    nrms: float
    nrms_aligned: float
    difference: float
    difference_time: float
    excess: float
    excess_time: float
    peak: float
    baseline_peak: float
    shift: float

    @property
    def relative_difference(self) -> float:
        """Largest difference over the scale."""
        return ratio(abs(self.difference), self.scale)

    @property
    def peak_difference(self) -> float:
        """Difference of the magnitudes of the peaks over that of the baseline."""
        difference = abs(self.peak) - abs(self.baseline_peak)
        return math.copysign(ratio(abs(difference), abs(self.baseline_peak)), difference)


def measure(result: Polyline, baseline: Polyline, half_width: float) -> Measures:
    """Measure how far a signal is from its baseline.

    Parameters
    ----------
    result, baseline : Polyline
        Signals over the same interval.
    half_width : float
        Tolerance in time [s].
    """
    smallest, largest = baseline.bounds()
    baseline_peak = _peak(baseline)
    varies = largest - smallest > CONSTANT * abs(baseline_peak)
    scale = largest - smallest if varies else abs(baseline_peak)
    difference, difference_time = _largest_difference(result, baseline)
    excess, excess_time = _largest_excess(result, baseline, half_width)
    rms = math.sqrt(mean_square(result, baseline))
    shift = time_shift(result, baseline) if varies and rms > 0.0 else 0.0
    return Measures(
        scale=scale,
        nrms=ratio(rms, scale),
        nrms_aligned=ratio(math.sqrt(mean_square(result, baseline, shift)), scale),
        difference=difference,
        difference_time=difference_time,
        excess=excess,
        excess_time=excess_time,
        peak=_peak(result),
        baseline_peak=baseline_peak,
        shift=shift,
    )


def ratio(part: float, whole: float) -> float:
    """Return part over whole, both at least 0; nothing of nothing is 0, anything else infinite."""
    if part == 0.0:
        return 0.0
    return part / whole if whole > 0.0 else math.inf


def _peak(signal: Polyline) -> float:
    return max(signal.bounds(), key=abs)


def _largest_difference(result: Polyline, baseline: Polyline) -> tuple[float, float]:
    """Return the difference of largest magnitude and its time; straight pieces have it at ends."""
    times = np.union1d(result.times, baseline.times)
    sides = np.stack(result.at(times)) - np.stack(baseline.at(times))
    side, k = np.unravel_index(np.argmax(np.abs(sides)), sides.shape)
    return float(sides[side, k]), float(times[k])


def _largest_excess(result: Polyline, baseline: Polyline, half_width: float) -> tuple[float, float]:
    """Return how far either signal leaves the other one's values close in time, and when.

    Both ways, because a narrow peak that the result lacks is within the tube of the baseline.
    """
    edges = [
        signal.times + offset
        for signal in (result, baseline)
        for offset in (-half_width, 0.0, half_width)
    ]
    times = np.unique(np.clip(np.concatenate(edges), *baseline.span))
    outside = np.maximum(
        _outside(result, baseline, times, half_width),
        _outside(baseline, result, times, half_width),
    )
    k = int(np.argmax(outside))
    return float(outside[k]), float(times[k])


def _outside(
    signal: Polyline, middle: Polyline, times: NDArray[np.float64], half_width: float
) -> NDArray[np.float64]:
    """Return how far a signal is outside of what another one is close to every time."""
    lowest, highest = middle.extremes(times, half_width)
    values = np.stack(signal.at(times))
    distance: NDArray[np.float64] = np.maximum(values - highest, lowest - values).max(axis=0)
    return np.maximum(distance, 0.0)
