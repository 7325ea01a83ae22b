"""Accepted points handed on in blocks, for who works on them while the run goes on."""

from collections.abc import Callable, Sequence

from .participant import Vector
from .recorder import Recorder


class PointBlocks(Recorder):
    """Recorder that keeps no points but gives them away, many at a time.

    Parameters
    ----------
    names : sequence of str
        ``participant.variable`` names.
    take : callable
        Takes times [s], shape (n,), and values, shape (n, n_names), which are reused afterwards.
    """

    def __init__(self, names: Sequence[str], take: Callable[[Vector, Vector], None]) -> None:
        self._take = take
        super().__init__(names)

    def finished(self) -> None:
        """Give the last ones away."""
        if self._filled:
            self._store_points()

    def _store_points(self) -> None:
        filled, self._filled = self._filled, 0
        self._take(self._times[:filled], self._rows[:filled])
