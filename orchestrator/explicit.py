"""Explicit coupling: every participant steps once, with inputs taken from the past where needed."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .block import Block
from .coupling import Attempt, Coupling
from .divergence import DivergenceMonitor
from .participant import InputShape, Matrix, Vector


@dataclass(frozen=True, slots=True, kw_only=True)
class Explicit:
    """Jacobi and Gauss-Seidel coupling.

    Jacobi takes all inputs within a block from the past, Gauss-Seidel only those whose sources
    step later. Unstable when the gain of a loop is 1 or more, with extrapolated inputs from 1/3 on
    where the loop opposes what drives it; of first order with held inputs and of second with
    extrapolated ones.

    Attributes
    ----------
    tears_everything : bool
        True for Jacobi.
    extrapolates : bool
        Whether inputs from the past are continued on a straight line, or held.
    """

    tears_everything: bool
    extrapolates: bool

    @property
    def input_shape(self) -> InputShape:
        """Straight lines to extrapolated values, else held."""
        return "linear" if self.extrapolates else "held"

    @property
    def allows_delay(self) -> bool:
        """Delays are what it is made of."""
        return True

    @property
    def uses_prediction(self) -> bool:
        """Only to extrapolate."""
        return self.extrapolates

    def couple(self, blocks: list[Block]) -> Coupling:
        """Return the algorithm for a system."""
        return ExplicitCoupling(blocks, extrapolates=self.extrapolates)


stepped_once = Attempt(None, 1, float("nan"))


class ExplicitCoupling:
    """One sweep over the blocks of a system.

    Parameters
    ----------
    blocks : list of Block
        Upstream first.
    extrapolates : bool
        Whether torn values are extrapolated or held.
    """

    iterates = False

    def __init__(self, blocks: list[Block], *, extrapolates: bool) -> None:
        self._blocks = blocks
        self._extrapolates = extrapolates
        self._loops = [
            (block, DivergenceMonitor(block.names, block.nominal))
            for block in blocks
            if block.unknowns.size
        ]
        self._time = self._size = 0.0
        self._expected = self._last = np.empty(0)
        self._before: tuple[Vector, float] | None = None

    @property
    def unreliable(self) -> Sequence[str]:
        """What was not resolved for long, a sentence each."""
        return [monitor.warning for _, monitor in self._loops if monitor.warning]

    def attempt(self, time: float, step_size: float, last: Vector, predicted: Vector) -> Attempt:
        """Step everything once."""
        values = predicted if self._extrapolates else last
        self._time, self._size, self._last = time, step_size, last
        self._expected = predicted if self._extrapolates else self._continued(last, step_size)
        for block in self._blocks:
            failure = block.step(values[block.unknowns], time, step_size)
            if failure is not None:
                return Attempt(failure, 1, float("nan"))
        return stepped_once

    def commit(self) -> None:
        """Compare what was expected in the last attempt with what came out."""
        for block, monitor in self._loops:
            monitor.accept(self._expected[block.unknowns], block.computed(), self._time)
        if not self._extrapolates:
            self._before = self._last.copy(), self._size

    def _continued(self, last: Vector, step_size: float) -> Vector:
        """Where a straight line leads: held values are missed by every slope, resolved or not."""
        if self._before is None:
            return last
        values, size = self._before
        return last + (step_size / size) * (last - values)

    def known(self, _step_size: float) -> Sequence[Matrix | None]:
        """Nothing is ever learned."""
        return ()

    def learn(self, jacobians: Sequence[Matrix | None]) -> None:
        """There is nothing to learn."""

    def forget(self) -> None:
        """Expect nothing of the next step."""
        self._before = None
        for _, monitor in self._loops:
            monitor.restart()
