"""Simulated time without accumulated rounding, and steps that fit to where they must end."""

from math import ceil
from typing import NamedTuple


class Step(NamedTuple):
    """A step that may be attempted.

    Attributes
    ----------
    start, size : float
        Start and size [s].
    landing : float or None
        The exact time at its end, when the step ends on the grid or at the stop time.
    """

    start: float
    size: float
    landing: float | None


class Clock:
    """The accepted time.

    With a grid, time is start + n * grid; between grid points, and without a grid, steps are summed
    with compensation. The stop time is hit exactly.

    Parameters
    ----------
    start, stop : float
        Start and stop time [s].
    min_step : float
        No step ordered by `plan` leaves less than this up to its goal [s].
    grid : float, optional
        Size of fixed steps [s].
    """

    def __init__(
        self, *, start: float, stop: float, min_step: float, grid: float | None = None
    ) -> None:
        self.time = start
        self._start = start
        self._stop = stop
        self._min_step = min_step
        self._grid = grid
        self._low = 0.0
        self._points = 0
        # Nearly a whole number of steps counts as one: the rest would be rounding.
        self._count = 1 if grid is None else max(1, ceil((stop - start) / grid * (1.0 - 1e-9)))
        self._sliver = 1e-12 * (stop - start) if grid is None else 1e-9 * grid
        self._goal = stop
        self._whole = stop - start
        self._on_point = False
        self._aim()

    @property
    def finished(self) -> bool:
        """Whether the stop time is reached."""
        return self.time == self._stop

    @property
    def remaining(self) -> float:
        """Time left up to the next grid point or the stop time [s]."""
        return (self._goal - self.time) - self._low

    def plan(self, size: float) -> Step:
        """Return a step of about `size` [s] that leaves no sliver before the goal."""
        remaining = self._whole if self._on_point else self.remaining
        if size >= remaining:
            return Step(self.time, remaining, self._goal)
        if remaining - size < self._min_step:
            half = 0.5 * remaining
            if half < self._min_step:
                return Step(self.time, remaining, self._goal)
            return Step(self.time, half, None)
        return Step(self.time, size, None)

    def plan_exactly(self, size: float) -> Step:
        """Return a step of `size` [s], up to the goal at most."""
        remaining = self._whole if self._on_point else self.remaining
        if size >= remaining:
            return Step(self.time, remaining, self._goal)
        return Step(self.time, size, None)

    def advance(self, step: Step) -> None:
        """Accept `step`."""
        if step.landing is not None:
            self.time, self._low = step.landing, 0.0
            self._points += 1
            self._aim()
            return
        # Two-sum: time + low is the sum of all steps to twice the working precision.
        size = step.size + self._low
        time = self.time + size
        shifted = time - self.time
        self._low = (self.time - (time - shifted)) + (size - shifted)
        self.time = time
        self._on_point = False
        if self.remaining <= self._sliver:
            self._skip_goal()

    def _skip_goal(self) -> None:
        """Do without the rest of an interval that is rounding rather than a step."""
        if self._goal == self._stop:
            self.time, self._low = self._stop, 0.0
            return
        self._points += 1
        self._aim()
        self._on_point = False

    def _aim(self) -> None:
        self._on_point = self._grid is not None
        if self._grid is None:
            return
        following = self._points + 1
        end = self._start + following * self._grid
        self._whole = self._grid
        if following < self._count:
            self._goal = end
            return
        self._goal = self._stop
        if abs(end - self._stop) > 1e-9 * self._grid:
            self._whole = self._stop - self.time
