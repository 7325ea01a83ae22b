"""Recorded series on a uniform grid, free of aliasing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy import signal

from ..errors import InputError

if TYPE_CHECKING:
    from numpy.typing import NDArray

FINER = 32
"""How much finer the first grid is, on which the low-pass filter works."""

PASSED, STOPPED = 0.8, 1.0
"""Ends of the filter's flanks over half the sampling rate."""

ATTENUATION = 80.0
"""What the filter leaves of what it stops, and its ripple [dB]."""

FEWEST_SAMPLES = 2
"""What makes a series."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Samples:
    """A series on a uniform grid.

    Attributes
    ----------
    x : ndarray, shape (n,)
        The grid.
    values : ndarray, shape (n, ...)
        The series there.
    rate : float
        Samples per unit of ``x``.
    limit : float
        Up to here the series shows what was recorded: the end of the filter's passband, or half
        the inverse of the longest recorded step, beyond which the recording itself may alias.
    """

    x: NDArray[np.float64]
    values: NDArray[np.float64]
    rate: float
    limit: float


def resample(x: NDArray[np.float64], values: NDArray[np.float64], rate: float) -> Samples:
    """Bring a series from the points of a run, straight between them, to a uniform grid.

    The means over the cells of a grid 32 times finer, exact for straight lines, go through a
    linear-phase low-pass filter without delay: up to 0.8 of half the sampling rate it passes
    within 0.1 %, from half the sampling rate on it stops by 80 dB, so that nothing folds back.
    Before its start and after its end the series counts as constant, which touches some 25
    samples there.

    Parameters
    ----------
    x : ndarray, shape (m,)
        Increasing times [s] or distances [m].
    values : ndarray, shape (m, ...)
        The series.
    rate : float
        Samples per second or metre.

    Returns
    -------
    Samples
        On a grid that starts with ``x[0]`` and ends with or less than a sample before ``x[-1]``.

    Raises
    ------
    InputError
        For a series that is shorter than one sample.
    """
    count = int(np.floor((x[-1] - x[0]) * rate * (1.0 + 1e-12))) + 1
    if count < FEWEST_SAMPLES:
        raise InputError(
            "the run is shorter than one sample: evaluate a longer run or raise evaluation.rate"
        )
    taps = _low_pass()
    delay = len(taps) // 2 // FINER
    cells = np.arange(-delay * FINER, (count - 1 + delay) * FINER + 2)
    # without the first value, the digits of small changes are kept
    integral = _integral(x, values - values[0], x[0] + (cells - 0.5) / (FINER * rate))
    means = np.diff(integral, axis=0) * (FINER * rate)
    filtered = signal.upfirdn(taps, means, down=FINER, axis=0)
    return Samples(
        x=x[0] + np.arange(count) / rate,
        values=filtered[2 * delay : 2 * delay + count] + values[0],
        rate=rate,
        limit=min(0.5 * PASSED * rate, 0.5 / float(np.diff(x).max())),
    )


def _low_pass() -> NDArray[np.float64]:
    """Design the filter for the finer grid; its delay is a whole number of samples."""
    # Kaiser's rule falls short by a few tenths of a decibel
    taps, beta = signal.kaiserord(ATTENUATION + 1.0, (STOPPED - PASSED) / FINER)
    delay = int(np.ceil(0.5 * taps / FINER))
    middle = 0.5 * (PASSED + STOPPED) / FINER
    return signal.firwin(2 * delay * FINER + 1, middle, window=("kaiser", beta))


def _integral(
    x: NDArray[np.float64], values: NDArray[np.float64], ends: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Integrate straight lines from ``x[0]`` on; before it zero, after ``x[-1]`` constant.

    Parameters
    ----------
    x : ndarray, shape (m,)
        Increasing abscissa.
    values : ndarray, shape (m, ...)
        Values there, zero at ``x[0]``.
    ends : ndarray, shape (n,)
        Ends of the integrals.

    Returns
    -------
    ndarray, shape (n, ...)
    """
    widths = _column(np.diff(x), values)
    areas = np.cumsum(0.5 * (values[:-1] + values[1:]) * widths, axis=0)
    before = np.concatenate((np.zeros_like(values[:1]), areas))
    inside = np.clip(ends, x[0], x[-1])
    k = np.clip(np.searchsorted(x, inside, side="right") - 1, 0, len(x) - 2)
    step = _column(inside - x[k], values)
    slope = (np.diff(values, axis=0) / widths)[k]
    after = _column(np.maximum(ends - x[-1], 0.0), values)
    return np.asarray(before[k] + step * (values[k] + 0.5 * step * slope) + after * values[-1])


def _column(numbers: NDArray[np.float64], like: NDArray[np.float64]) -> NDArray[np.float64]:
    """Shape numbers so that they multiply the rows of an array."""
    return numbers.reshape(-1, *(1,) * (like.ndim - 1))
