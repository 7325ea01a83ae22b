"""Safeguarded search for the first switch within a step."""

from collections.abc import Sequence
from typing import NamedTuple

Point = tuple[float, tuple[float, ...]]
"""Step size [s] and the signed indicators there, positive before their switch."""

most_others = 2
"""Points used besides the ends of the bracket: cubic interpolation."""

bisections = 50
"""Halvings that find the root of an interpolation polynomial."""


class Bracket(NamedTuple):
    """A range of step sizes that holds a switch.

    Attributes
    ----------
    low, high : Point
        The ends: nothing has switched at `low`, something has at `high`.
    others : tuple of Point
        More points on the same smooth course, the closest ones first.
    nearest : float
        Smallest distance of an attempt from the switch, in the unit of the indicator.
    stalled : bool
        Whether the last attempt halved neither that distance nor the bracket.
    """

    low: Point
    high: Point
    others: tuple[Point, ...]
    nearest: float = float("inf")
    stalled: bool = False

    @property
    def width(self) -> float:
        """Distance of the ends [s]."""
        return self.high[0] - self.low[0]

    def narrowed(self, point: Point, *, crossed: bool) -> "Bracket":
        """Return the bracket with `point` as its new upper or lower end."""
        low, high = (self.low, point) if crossed else (point, self.high)
        replaced = self.high if crossed else self.low
        others = self.others
        if replaced[0] != point[0]:
            others = (replaced, *others)[:most_others]
        distance = abs(min(point[1]))
        stalled = distance > 0.5 * self.nearest and high[0] - low[0] > 0.5 * self.width
        return Bracket(low, high, others, min(distance, self.nearest), stalled)

    def next_size(self, *, tolerance: float, at_rest: tuple[bool, ...], margin: float) -> float:
        """Return the step size to try next [s]: the earliest of the estimated switches.

        Parameters
        ----------
        tolerance : float
            Indicators below minus this have switched.
        at_rest : tuple of bool
            Whether an indicator is still where its last switch left it at a step size of zero;
            that point then is no switch.
        margin : float
            Distance to keep from the ends [s].
        """
        middle = 0.5 * (self.low[0] + self.high[0])
        if self.stalled or self.width <= 2.0 * margin:
            return middle
        sizes = [
            self._estimate(place, starts_at_zero=at_rest[place] and self.low[0] == 0.0)
            for place, value in enumerate(self.high[1])
            if value < -tolerance
        ]
        size = min((size for size in sizes if size is not None), default=middle)
        return min(max(size, self.low[0] + margin), self.high[0] - margin)

    def _estimate(self, place: int, *, starts_at_zero: bool) -> float | None:
        points = [(size, values[place]) for size, values in (self.low, self.high, *self.others)]
        if starts_at_zero:
            # Divided by the step size, the known root at zero is gone and the next one is left.
            points = [(size, value / size) for size, value in points if size > 0.0]
        return root_of_interpolation(points, self.low[0], self.high[0])


def root_of_interpolation(
    points: Sequence[tuple[float, float]], low: float, high: float
) -> float | None:
    """Return where the polynomial through `points` falls through zero between `low` and `high`.

    Returns None unless it is positive at `low` and negative at `high`.
    """
    nodes = [node for node, _ in points]
    differences = [value for _, value in points]
    for order in range(1, len(nodes)):
        for place in range(len(nodes) - 1, order - 1, -1):
            rise = differences[place] - differences[place - 1]
            differences[place] = rise / (nodes[place] - nodes[place - order])

    def polynomial(at: float) -> float:
        value = differences[-1]
        for node, difference in zip(nodes[-2::-1], differences[-2::-1], strict=True):
            value = value * (at - node) + difference
        return value

    if not polynomial(low) > 0.0 > polynomial(high):
        return None
    for _ in range(bisections):
        middle = 0.5 * (low + high)
        if polynomial(middle) > 0.0:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)
