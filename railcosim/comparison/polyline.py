"""A signal between its samples: straight lines, with jumps where a time stands twice."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    Limits = tuple[NDArray[np.float64], NDArray[np.float64]]
    Choose = Callable[[NDArray[np.float64], NDArray[np.float64]], NDArray[np.float64]]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Polyline:
    """A signal that is a straight line between its times and may jump at them.

    Attributes
    ----------
    times : ndarray, shape (n,)
        Strictly increasing times [s], two at least.
    before, after : ndarray, shape (n,)
        Limits from the left and from the right at these times; equal where nothing jumps.
    """

    times: NDArray[np.float64]
    before: NDArray[np.float64]
    after: NDArray[np.float64]

    @classmethod
    def through(
        cls, times: NDArray[np.float64], values: NDArray[np.generic], *, held: bool = False
    ) -> Polyline:
        """Join samples.

        Parameters
        ----------
        times : ndarray, shape (m,)
            Times [s] that do not decrease. Of samples with the same time, the first is the value
            before a jump and the last the value after it.
        values : ndarray, shape (m,)
            Finite samples.
        held : bool
            Whether a sample holds until the next one, as it does for Booleans.
        """
        numbers = values.astype(float)
        first, last = _groups(times)
        before, after = numbers[first], numbers[last]
        if held:
            before = np.concatenate([before[:1], after[:-1]])
        return cls(times=times[first], before=before, after=after)

    @property
    def span(self) -> tuple[float, float]:
        """First and last time [s]."""
        return float(self.times[0]), float(self.times[-1])

    def at(self, times: NDArray[np.float64]) -> Limits:
        """Return the limits from the left and from the right.

        Parameters
        ----------
        times : ndarray, shape (k,)
            Times [s]; outside of the signal its first and last values continue.

        Returns
        -------
        tuple of two ndarray, shape (k,)
            Values just before and just after these times.
        """
        within = np.clip(times, *self.span)
        return self._inside(within, "left"), self._inside(within, "right")

    def cut(self, start: float, stop: float) -> Polyline:
        """Return the part between two times [s] within the signal."""
        inside = self.times[(self.times > start) & (self.times < stop)]
        times = np.concatenate([[start], inside, [stop]])
        before, after = self.at(times)
        before[0], after[-1] = after[0], before[-1]
        return Polyline(times=times, before=before, after=after)

    def shifted(self, by: float) -> Polyline:
        """Return the same signal later by a time [s]; times that are one after rounding join."""
        times = self.times + by
        first, last = _groups(times)
        return Polyline(times=times[first], before=self.before[first], after=self.after[last])

    def extremes(self, times: NDArray[np.float64], half_width: float) -> Limits:
        """Return the smallest and the largest value close to every time.

        Parameters
        ----------
        times : ndarray, shape (k,)
            Times [s].
        half_width : float
            How far before and after a time values count [s].

        Returns
        -------
        tuple of two ndarray, shape (k,)
            Smallest and largest value, exact: a straight line has its extremes at its ends.
        """
        ends = [*self.at(times - half_width), *self.at(times + half_width)]
        begin = np.searchsorted(self.times, times - half_width, side="left")
        end = np.searchsorted(self.times, times + half_width, side="right")
        smallest = _extreme(np.minimum, np.minimum(self.before, self.after), begin, end)
        largest = _extreme(np.maximum, np.maximum(self.before, self.after), begin, end)
        return np.minimum.reduce([*ends, smallest]), np.maximum.reduce([*ends, largest])

    def bounds(self) -> tuple[float, float]:
        """Return the smallest and the largest value."""
        values = np.concatenate([self.before, self.after])
        return float(values.min()), float(values.max())

    def _inside(
        self, times: NDArray[np.float64], side: Literal["left", "right"]
    ) -> NDArray[np.float64]:
        """Interpolate on the piece to the left or to the right of every time."""
        found = np.searchsorted(self.times, times, side=side) - 1
        k = np.clip(found, 0, self.times.size - 2)
        weight = (times - self.times[k]) / (self.times[k + 1] - self.times[k])
        # at both ends of a piece exactly its sample
        inside: NDArray[np.float64] = (1.0 - weight) * self.after[k] + weight * self.before[k + 1]
        outer = self.before[0] if side == "left" else self.after[-1]
        edge = times == (self.times[0] if side == "left" else self.times[-1])
        return np.where(edge, outer, inside)


def _groups(times: NDArray[np.float64]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the first and the last index of every time, of times that do not decrease."""
    first = np.flatnonzero(np.diff(times, prepend=-np.inf) > 0.0)
    return first, np.append(first[1:], times.size) - 1


def _extreme(
    choose: Choose,
    values: NDArray[np.float64],
    begin: NDArray[np.intp],
    end: NDArray[np.intp],
) -> NDArray[np.float64]:
    """Return the extreme of every ``values[begin:end]``; of an empty one, that of all its limits.

    A table of the extremes of 1, 2, 4, ... neighbours: two of them cover any window.
    """
    neutral = np.inf if choose is np.minimum else -np.inf
    result = np.full(begin.shape, neutral)
    level = np.frexp(np.maximum(end - begin, 1))[1] - 1  # the largest power of two that fits
    table = values
    for power in range(int(level.max(initial=0)) + 1):
        chosen = (level == power) & (end > begin)
        first, last = begin[chosen], end[chosen] - 2**power
        result[chosen] = choose(table[first], table[last])
        table = choose(table[: -(2**power)], table[2**power :]) if table.size > 2**power else table
    return result
