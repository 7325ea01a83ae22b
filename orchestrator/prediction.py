"""The straight line through the last two accepted points."""

import numpy as np

from .participant import Vector


class History:
    """Accepted values of the exchanged variables, and what they lead to expect.

    Parameters
    ----------
    lower, upper : numpy.ndarray, shape (n,)
        Bounds that no prediction leaves.
    """

    def __init__(self, lower: Vector, upper: Vector) -> None:
        self._lower = lower
        self._upper = upper
        self._bounded = bool(np.isfinite(lower).any() or np.isfinite(upper).any())
        self._slope: Vector | None = None
        self._last: Vector = np.zeros(lower.size)

    @property
    def has_slope(self) -> bool:
        """Whether two points are known since the last restart."""
        return self._slope is not None

    @property
    def last(self) -> Vector:
        """Values at the last accepted point, shape (n,)."""
        return self._last

    @property
    def slope(self) -> Vector | None:
        """Slope of the line through the last two points, shape (n,)."""
        return self._slope

    def resume(self, values: Vector, slope: Vector | None) -> None:
        """Stand at a point with the slope of a line through it."""
        self._last, self._slope = values, slope

    def restart(self, values: Vector) -> None:
        """Forget all points but this one."""
        self._last = values
        self._slope = None

    def append(self, values: Vector, step_size: float) -> None:
        """Add the point `step_size` [s] after the last one; the array must not change later."""
        self._slope = (values - self._last) / step_size
        self._last = values

    def predict(self, step_size: float) -> Vector:
        """Return the values expected after `step_size` [s], within bounds; a new array."""
        if self._slope is None:
            return self._last.copy()
        values: Vector = self._slope * step_size
        values += self._last
        if self._bounded:
            np.maximum(values, self._lower, out=values)
            np.minimum(values, self._upper, out=values)
        return values
