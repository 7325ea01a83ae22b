"""What every coupling algorithm is to the master."""

from collections.abc import Sequence
from typing import NamedTuple, Protocol

from .block import Block
from .decision import Failure
from .participant import InputShape, Matrix, Vector


class Attempt(NamedTuple):
    """What came of trying a step.

    Attributes
    ----------
    failure : Failure or None
        Why there is no result, if there is none.
    iterations : int
        How often the coupled participants were stepped.
    residual_norm : float
        Largest remaining residual over the nominal value; NaN when it was not computed.
    """

    failure: Failure | None
    iterations: int
    residual_norm: float


class Coupling(Protocol):
    """A way to find the values exchanged at the end of a step.

    An attempt leaves the participants and the flat arrays at the candidate. What it learns counts
    only after `commit`, so that an attempt that was thrown away repeats itself bit for bit.
    """

    @property
    def iterates(self) -> bool:
        """Whether an attempt steps a participant more than once."""

    @property
    def unreliable(self) -> Sequence[str]:
        """What makes the result wrong, a sentence each."""

    def attempt(self, time: float, step_size: float, last: Vector, predicted: Vector) -> Attempt:
        """Try the step from `time` by `step_size` [s].

        `last` and `predicted` are the exchanged values at the last accepted point and those
        expected at the end of the step, shape (n_values,).
        """

    def commit(self) -> None:
        """Keep what the last attempt learned.

        Raises
        ------
        DivergenceError
            When the accepted steps leave no hope.
        """

    def known(self, step_size: float) -> Sequence[Matrix | None]:
        """Return the Jacobians of an attempt of `step_size` [s], as far as there are any."""

    def learn(self, jacobians: Sequence[Matrix | None]) -> None:
        """Start the next attempt from these Jacobians, which `known` gave."""

    def forget(self) -> None:
        """Keep nothing: the participants have switched."""


class Algorithm(Protocol):
    """A coupling algorithm before it knows its system."""

    @property
    def input_shape(self) -> InputShape:
        """How inputs should run over a step."""

    @property
    def tears_everything(self) -> bool:
        """Whether every connection within a block is torn."""

    @property
    def allows_delay(self) -> bool:
        """Whether a participant may get values from the past of one that steps last."""

    @property
    def uses_prediction(self) -> bool:
        """Whether an attempt looks at the predicted values."""

    def couple(self, blocks: list[Block]) -> Coupling:
        """Return the algorithm for a system."""
