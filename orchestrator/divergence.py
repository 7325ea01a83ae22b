"""Whether an explicit coupling still follows the values that it takes from the past."""

from collections.abc import Sequence

import numpy as np

from .errors import DivergenceError
from .participant import Vector

window = 16
"""Accepted steps that are looked at together."""

unresolved = 0.25
"""A miss is large when it exceeds this share of the value's own range within the window.

A wave of eight steps per period that is extrapolated, or of twelve that is held, is missed so.
"""

quiet = 1e-3
"""Misses below this, over the nominal value, are left alone."""

diverging = 100.0
"""Growth of unresolved misses, window after window without a pause, that ends the run."""

fewest_windows = 4
"""An impact is unresolved for one or two windows; it takes more than that to diverge."""

lasting_windows = 20
"""Misses that last so long, in many steps of every window, make the result worthless."""

many = 0.25
"""Share of a window's steps. A kink, as at a node of the rail, is missed in one or two of 16."""


class DivergenceMonitor:
    """Follows by how much the torn values of a loop miss what was prescribed for them.

    In a run that resolves its values the miss is small against their own variation. In one that
    diverges it is as large, because the values jump about from step to step, and it grows.

    Parameters
    ----------
    names : sequence of str
        Torn values, as ``participant.variable``.
    nominal : numpy.ndarray, shape (n,)
        Their scale.
    """

    def __init__(self, names: Sequence[str], nominal: Vector) -> None:
        self._names = tuple(names)
        self._nominal = nominal
        self._prescribed = np.zeros((window, len(self._names)))
        self._computed = np.zeros((window, len(self._names)))
        self._count = 0
        self._restarted = True
        self._streak: list[float] = []
        self._lasting = 0
        self.warning = ""

    def restart(self) -> None:
        """Pass over the next step: nothing smooth leads to it."""
        self._restarted = True

    def accept(self, prescribed: Vector, computed: Vector, time: float) -> None:
        """Look at an accepted step that began at `time` [s].

        Raises
        ------
        DivergenceError
            When the miss has been large and growing for several windows.
        """
        if self._restarted:
            self._restarted = False
            return
        self._prescribed[self._count] = prescribed
        self._computed[self._count] = computed
        self._count += 1
        if self._count == window:
            self._count = 0
            self._examine(time)

    def _examine(self, time: float) -> None:
        misses = np.abs(self._computed - self._prescribed)
        bound = np.maximum(quiet * self._nominal, unresolved * np.ptp(self._computed, axis=0))
        self._follow_growth(misses.max(axis=0), bound, time)
        self._follow_jumps(np.quantile(misses, 1.0 - many, axis=0), bound, time)

    def _follow_growth(self, misses: Vector, bound: Vector, time: float) -> None:
        worst = self._worst(misses, bound)
        if worst is None:
            self._streak.clear()
            return
        miss = float(misses[worst] / self._nominal[worst])
        del self._streak[:-lasting_windows]
        self._streak.append(miss)
        smallest = min(self._streak[: 1 - fewest_windows], default=miss)
        # not in one window only: an impact is over when the next one has passed
        if min(self._streak[-2:]) > diverging * smallest:
            raise DivergenceError(
                f"The explicit algorithm diverges: {self._names[worst]} missed the value expected "
                f"of it by {miss:.3g} times its nominal value {self._nominal[worst]:.3g} shortly "
                f"before t = {time:.9g} s, {miss / smallest:.3g} times as much as "
                f"{window * len(self._streak)} steps earlier; use the algorithm newton or a "
                "smaller step."
            )

    def _follow_jumps(self, misses: Vector, bound: Vector, time: float) -> None:
        worst = self._worst(misses, bound)
        self._lasting = 0 if worst is None else self._lasting + 1
        if worst is not None and self._lasting > lasting_windows and not self.warning:
            self.warning = (
                "The steps of the explicit algorithm are too large for "
                f"{self._names[worst]}, which jumps about from step to step around "
                f"t = {time:.9g} s by {float(misses[worst] / self._nominal[worst]):.3g} times its "
                f"nominal value {self._nominal[worst]:.3g}; use the algorithm newton or a smaller "
                "step."
            )

    def _worst(self, misses: Vector, bound: Vector) -> int | None:
        """Value with the largest miss beyond its bound, if there is one."""
        large = misses > bound
        if not large.any():
            return None
        return int(np.argmax(np.where(large, misses / self._nominal, 0.0)))
