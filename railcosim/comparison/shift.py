"""How much later one signal is than another."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.signal import correlate

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .polyline import Polyline

FARTHEST = 0.1
"""Longest lag that is sought, over the compared interval."""

MOST_SAMPLES = 2**13
"""Samples of the even grid on which the best lag is sought first, at most."""

PRECISION = 1e-3
"""Precision of the lag, over the spacing of that grid."""


def time_shift(result: Polyline, baseline: Polyline) -> float:
    """Return the lag that makes two signals most alike.

    Alike is where the mean of the squared difference over what is left of the common interval is
    smallest: found by cross-correlation on an even grid, then between its points on the signals
    themselves. Unlike the largest correlation, this is right for signals that drift, too.

    Parameters
    ----------
    result, baseline : Polyline
        Signals over the same interval.

    Returns
    -------
    float
        Lag [s], at most a tenth of the interval; above 0 where the result is later, 0 where no lag
        makes the signals more alike.
    """
    start, stop = baseline.span
    finest = min(np.diff(result.times).min(), np.diff(baseline.times).min())
    finest = max(finest, (stop - start) / MOST_SAMPLES)
    count = max(int((stop - start) / finest), 64) + 1
    grid = np.linspace(start, stop, count)
    spacing = (stop - start) / (count - 1)
    errors = _squared_differences(result.at(grid)[1], baseline.at(grid)[1])
    reach = errors.size // 2
    best = int(np.argmin(errors)) - reach
    farthest = reach * spacing

    def error(lag: float) -> float:
        return mean_square(result, baseline, lag)

    least = minimize_scalar(
        error,
        bounds=(
            max((best - 1) * spacing, -farthest),
            min((best + 1) * spacing, farthest),
        ),
        method="bounded",
        options={"xatol": PRECISION * spacing},
    )
    return float(least.x) if least.fun < error(0.0) else 0.0


def mean_square(result: Polyline, baseline: Polyline, lag: float = 0.0) -> float:
    """Return the mean over time of the squared difference, the result taken earlier by ``lag``.

    Exact for straight pieces, on whatever times either signal has them.

    Parameters
    ----------
    result, baseline : Polyline
        Signals that overlap by more than the lag.
    lag : float
        Time by which the result comes later [s].
    """
    moved = result.shifted(-lag)
    start = max(moved.span[0], baseline.span[0])
    stop = min(moved.span[1], baseline.span[1])
    times = np.union1d(moved.times, baseline.times)
    times = np.concatenate([[start], times[(times > start) & (times < stop)], [stop]])
    first = (moved.at(times)[1] - baseline.at(times)[1])[:-1]
    last = (moved.at(times)[0] - baseline.at(times)[0])[1:]
    squares = (first * first + first * last + last * last) / 3.0
    return float(np.sum(squares * np.diff(times)) / (stop - start))


def _squared_differences(
    result: NDArray[np.float64], baseline: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the mean squared difference for every lag from -reach to reach samples."""
    count = result.size
    reach = max(int(FARTHEST * count), 1)
    lags = np.arange(-reach, reach + 1)
    middle = 0.5 * (baseline.max() + baseline.min())  # large offsets would cost digits
    a, b = result - middle, baseline - middle
    products = correlate(a, b, mode="full", method="fft")[count - 1 + lags]
    before = np.concatenate([[0.0], np.cumsum(a * a)]), np.concatenate([[0.0], np.cumsum(b * b)])
    late, early = np.maximum(lags, 0), np.maximum(-lags, 0)
    energy = (before[0][count - early] - before[0][late]) + (
        before[1][count - late] - before[1][early]
    )
    squares: NDArray[np.float64] = (energy - 2.0 * products) / (count - np.abs(lags))
    return squares
