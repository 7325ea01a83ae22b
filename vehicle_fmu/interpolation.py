"""Curves through tabulated points, evaluated one number at a time."""

from bisect import bisect_right

import numpy as np

from .validation import FloatArray


class PiecewiseCubic:
    """A continuous piecewise cubic; constant beyond its ends, at the value it has there.

    Parameters
    ----------
    breaks : ndarray, shape (n,)
        Strictly increasing abscissas.
    values : ndarray, shape (n,)
        Value at each break.
    slopes : ndarray, shape (n - 1, 2)
        First derivative at the left and at the right end of each piece.
    """

    def __init__(self, breaks: FloatArray, values: FloatArray, slopes: FloatArray) -> None:
        width = np.diff(breaks)
        chord = np.diff(values) / width
        left, right = slopes[:, 0], slopes[:, 1]
        pieces = (
            breaks[:-1],
            values[:-1],
            left,
            (3.0 * chord - 2.0 * left - right) / width,
            (left + right - 2.0 * chord) / width**2,
        )
        self._breaks: list[float] = breaks.tolist()
        self._pieces: list[tuple[float, ...]] = list(
            zip(*(column.tolist() for column in pieces), strict=True)
        )
        self._first = float(values[0])
        self._last = float(values[-1])

    def __call__(self, x: float) -> float:
        """Return the value at `x`."""
        breaks = self._breaks
        if x <= breaks[0]:
            return self._first
        if x >= breaks[-1]:
            return self._last
        start, c0, c1, c2, c3 = self._pieces[bisect_right(breaks, x) - 1]
        d = x - start
        return c0 + d * (c1 + d * (c2 + d * c3))


def linear_curve(x: FloatArray, y: FloatArray) -> PiecewiseCubic:
    """Return the straight lines between n >= 2 points."""
    chord = np.diff(y) / np.diff(x)
    return PiecewiseCubic(x, y, np.column_stack((chord, chord)))


def monotone_curve(x: FloatArray, y: FloatArray) -> PiecewiseCubic:
    """Return the smooth curve through n >= 3 points that never leaves the range of two neighbours.

    PCHIP: the slope at an inner point is the harmonic mean of the adjacent chords weighted as by
    Fritsch & Butland (1984), or zero at a local extremum; at the ends it is that of the parabola
    through three points, limited so that the curve stays monotone.
    """
    width = np.diff(x)
    chord = np.diff(y) / width
    slope = np.empty_like(y)
    slope[1:-1] = _inner_slopes(width, chord)
    slope[0] = _end_slope(width[0], width[1], chord[0], chord[1])
    slope[-1] = _end_slope(width[-1], width[-2], chord[-1], chord[-2])
    return PiecewiseCubic(x, y, np.column_stack((slope[:-1], slope[1:])))


def periodic_monotone_curve(x: FloatArray, y: FloatArray, period: float) -> PiecewiseCubic:
    """Return one period of a smooth curve through n >= 3 points and again through the first.

    As `monotone_curve`, with the slope at every point that of an inner one.

    Parameters
    ----------
    x : ndarray, shape (n,)
        Strictly increasing abscissas, the last less than `period` above the first.
    y : ndarray, shape (n,)
        Value at each of them.
    period : float
        Length after which the curve comes back.

    Returns
    -------
    PiecewiseCubic
        From the first abscissa to that plus the period.
    """
    breaks, values = np.append(x, x[0] + period), np.append(y, y[0])
    width = np.diff(breaks)
    chord = np.diff(values) / width
    around = _inner_slopes(np.append(width[-1], width), np.append(chord[-1], chord))
    slope = np.append(around, around[0])
    return PiecewiseCubic(breaks, values, np.column_stack((slope[:-1], slope[1:])))


def _inner_slopes(width: FloatArray, chord: FloatArray) -> FloatArray:
    """Return the slopes between n neighbouring chords of these widths, shape (n - 1,)."""
    slope = np.zeros(chord.size - 1)
    same_way = chord[:-1] * chord[1:] > 0.0
    before, after = chord[:-1][same_way], chord[1:][same_way]
    w_before = (2.0 * width[1:] + width[:-1])[same_way]
    w_after = (width[1:] + 2.0 * width[:-1])[same_way]
    mixed = w_before * after + w_after * before
    slope[same_way] = (w_before + w_after) * before / mixed * after
    return slope


def _end_slope(h0: float, h1: float, chord0: float, chord1: float) -> float:
    """Return the one-sided slope at an end whose nearest chord is `chord0`."""
    slope = ((2.0 * h0 + h1) * chord0 - h0 * chord1) / (h0 + h1)
    if slope * chord0 <= 0.0:
        return 0.0
    if chord0 * chord1 <= 0.0 and abs(slope) > 3.0 * abs(chord0):
        return 3.0 * chord0
    return slope
