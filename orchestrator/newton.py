"""Implicit coupling: steps are repeated until inputs and outputs agree at the end of the step."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .block import Block
from .coupling import Attempt, Coupling
from .decision import Failure
from .participant import InputShape, Matrix, Vector
from .quasi_newton import FixedPoint


@dataclass(frozen=True, slots=True, kw_only=True)
class Newton:
    """Quasi-Newton iteration on the torn values of each block; the secant rule for a single one.

    Converges whatever the gain of the loop. With inputs on straight lines it is of second order.

    Attributes
    ----------
    tolerance : float
        Largest residual of a torn value over its nominal value.
    max_iterations : int
        How often the torn values are corrected at most in one attempt.
    """

    tolerance: float
    max_iterations: int

    @property
    def input_shape(self) -> InputShape:
        """Straight lines."""
        return "linear"

    @property
    def tears_everything(self) -> bool:
        """Only what must be."""
        return False

    @property
    def allows_delay(self) -> bool:
        """All values belong to the same time."""
        return False

    @property
    def uses_prediction(self) -> bool:
        """As the first guess."""
        return True

    def couple(self, blocks: list[Block]) -> Coupling:
        """Return the algorithm for a system."""
        return NewtonCoupling(
            [(block, fixed_point(block, self.tolerance, self.max_iterations)) for block in blocks]
        )


def fixed_point(block: Block, tolerance: float, max_iterations: int) -> FixedPoint:
    """Return the equations of the torn values of `block`."""
    return FixedPoint(
        names=block.names,
        nominal=block.nominal,
        lower=block.lower,
        upper=block.upper,
        tolerance=tolerance,
        max_iterations=max_iterations,
    )


most_step_sizes = 256
"""Step sizes whose Jacobians are kept; a run that never repeats a size keeps no more."""


class NewtonCoupling:
    """The iteration for one system, with the Jacobians kept from step to step.

    What a participant answers to a change of its inputs depends on the size of the step, so that
    each size has Jacobians of its own; a new size starts from those used last.

    Parameters
    ----------
    equations : list of (Block, FixedPoint)
        Blocks, upstream first.
    """

    unreliable = ()

    def __init__(self, equations: list[tuple[Block, FixedPoint]]) -> None:
        self._equations = equations
        self._bounded = [bool(np.isfinite([e.lower, e.upper]).any()) for _, e in equations]
        self._by_step_size: dict[float, list[Matrix | None]] = {}
        self._last: list[Matrix | None] = [None] * len(equations)
        self._step_size = 0.0
        self._learned = list(self._last)

    @property
    def iterates(self) -> bool:
        """Whether any block has something to iterate on."""
        return any(block.unknowns.size for block, _ in self._equations)

    def attempt(self, time: float, step_size: float, last: Vector, predicted: Vector) -> Attempt:
        """Try the step, starting from the predicted values."""
        del last  # the prediction is the better guess
        iterations, residual_norm = 1, 0.0
        known = self.known(step_size)
        self._step_size, self._learned = step_size, list(known)
        for place, (block, equations) in enumerate(self._equations):
            unknowns = predicted[block.unknowns]
            if not unknowns.size:
                failure = block.step(unknowns, time, step_size)
                if failure is not None:
                    return Attempt(failure, iterations, residual_norm)
                continue
            if self._bounded[place]:
                unknowns = np.clip(unknowns, equations.lower, equations.upper)

            def evaluate(values: Vector, block: Block = block) -> Failure | None:
                return block.step(values, time, step_size)

            solution = equations.solve(
                evaluate, block.computed, unknowns, known[place], block.guess
            )
            self._learned[place] = solution.inverse
            iterations = max(iterations, solution.evaluations)
            residual_norm = max(residual_norm, solution.residual_norm)
            if solution.failure is not None:
                return Attempt(solution.failure, iterations, residual_norm)
        return Attempt(None, iterations, residual_norm)

    def commit(self) -> None:
        """Keep the Jacobians of the last attempt."""
        known = self._by_step_size
        self._last = known[self._step_size] = self._learned
        if len(known) > most_step_sizes:
            del known[next(iter(known))]

    def known(self, step_size: float) -> Sequence[Matrix | None]:
        """Return the Jacobians of that size, else those used last."""
        return self._by_step_size.get(step_size, self._last)

    def learn(self, jacobians: Sequence[Matrix | None]) -> None:
        """Take these as those used last."""
        self._by_step_size.clear()
        self._last = list(jacobians)

    def forget(self) -> None:
        """Find the Jacobians anew in the next attempt."""
        self._by_step_size.clear()
        self._last = [None] * len(self._last)
