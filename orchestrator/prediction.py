"""The straight line through the last accepted point and another one."""

import numpy as np

from .participant import Vector


class History:
    """Accepted values of the exchanged variables, and what they lead to expect.

    Parameters
    ----------
    lower, upper : numpy.ndarray, shape (n,)
        Bounds that no prediction leaves, unless the value has left them.
    """

    def __init__(self, lower: Vector, upper: Vector) -> None:
        self._lower = lower
        self._upper = upper
        self._bounded = bool(np.isfinite(lower).any() or np.isfinite(upper).any())
        self._slope: Vector | None = None
        self._last: Vector = np.zeros(lower.size)
        self._behind = 0.0

    @property
    def has_slope(self) -> bool:
        """Whether there is a line to continue since the last restart."""
        return self._slope is not None

    @property
    def has_past(self) -> bool:
        """Whether the line comes from two accepted points."""
        return self._behind > 0.0

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
        self._behind = 0.0

    def append(self, values: Vector, step_size: float) -> None:
        """Add the point `step_size` [s] after the last one; the array must not change later."""
        self._slope = (values - self._last) / step_size
        self._last = values
        self._behind = step_size

    def look_ahead(self, values: Vector, step_size: float) -> None:
        """Take the slope from an attempt of `step_size` [s] that was not accepted."""
        self._slope = (values - self._last) / step_size
        self._behind = -step_size

    def curvature_factor(self, step_size: float) -> float:
        """Return what turns the miss of a prediction over `step_size` h [s] into h^2 |y''|.

        A straight line through the last point and one b before it (or -b ahead) misses by
        h (h + b) |y''| / 2, so that the factor is 1 after a step of the same size.
        """
        return 2.0 * step_size / abs(step_size + self._behind)

    def predict(self, step_size: float) -> Vector:
        """Return the values expected after `step_size` [s]; a new array.

        Those whose last value is within its bounds stay there; another one is continued as it is,
        because clipping would pull it away from what its participant answers.
        """
        if self._slope is None:
            return self._last.copy()
        values: Vector = self._slope * step_size
        values += self._last
        if self._bounded:
            np.maximum(values, self._lower, out=values, where=self._last >= self._lower)
            np.minimum(values, self._upper, out=values, where=self._last <= self._upper)
        return values
