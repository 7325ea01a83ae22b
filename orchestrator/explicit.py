"""Explicit coupling: every participant steps once, with inputs taken from the past where needed."""

from dataclasses import dataclass

from .block import Block
from .coupling import Attempt, Coupling
from .participant import InputShape, Vector


@dataclass(frozen=True, slots=True, kw_only=True)
class Explicit:
    """Jacobi and Gauss-Seidel coupling.

    Jacobi takes all inputs within a block from the past, Gauss-Seidel only those whose sources
    step later. Unstable when the gain of an algebraic loop is 1 or more; of first order with held
    inputs and of second with extrapolated ones.

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

    def attempt(self, time: float, step_size: float, last: Vector, predicted: Vector) -> Attempt:
        """Step everything once."""
        values = predicted if self._extrapolates else last
        for block in self._blocks:
            failure = block.step(values[block.unknowns], time, step_size)
            if failure is not None:
                return Attempt(failure, 1, float("nan"))
        return Attempt(None, 1, float("nan"))

    def commit(self) -> None:
        """Learn nothing."""

    def forget(self) -> None:
        """Know nothing to forget."""
