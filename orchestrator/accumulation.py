"""Switches whose intervals shrink like a geometric series: the time at which they accumulate."""

from math import exp, log

fewest_ratios = 3
"""Ratios of intervals that must agree before anything is expected of them."""

scatter = 0.05
"""How far a ratio may lie from the mean of those before it, over its distance from 0 or 1."""


class GeometricIntervals:
    """The latest intervals between switches of one kind, as long as they shrink steadily.

    Where all intervals shrink by about the same ratio q, the time left before infinitely many of
    them are over is the last one times q / (1 - q). An impact of finite duration adds that to each
    interval, so that ratios move towards one as bounces get lower; then the series begins anew.

    Parameters
    ----------
    share : float
        The time left over the time since the series began, below which it is believed.
    """

    __slots__ = ("_begin", "_count", "_first", "_interval", "_share", "_time")

    def __init__(self, share: float) -> None:
        self._share = share
        self._time: float | None = None
        self._interval: float | None = None
        self._begin = self._first = 0.0
        self._count = 0

    def add(self, time: float) -> float | None:
        """Add a switch at `time` [s], later than those before.

        Returns
        -------
        float or None
            When the switches accumulate [s], or None while there is no such sign.
        """
        last, before = self._time, self._interval
        self._time = time
        if last is None:
            return None
        interval = self._interval = time - last
        if before is None or not 0.0 < interval < before:
            self._count = 0
            return None
        ratio = interval / before
        if self._count == 0 or not self._agrees(ratio, before):
            self._begin, self._first, self._count = last - before, before, 1
            return None
        self._count += 1
        if self._count < fewest_ratios:
            return None
        mean = self._mean(interval)
        rest = interval * mean / (1.0 - mean)
        return time + rest if rest <= self._share * (time - self._begin) else None

    def _agrees(self, ratio: float, before: float) -> bool:
        mean = self._mean(before)
        return abs(ratio - mean) <= scatter * min(mean, 1.0 - mean)

    def _mean(self, interval: float) -> float:
        return exp(log(interval / self._first) / self._count)
