"""Who watches a run: results and progress displays are observers."""

from collections.abc import Mapping, Sequence
from typing import Protocol

from .participant import Variable, Vector
from .step_log import StepLog


class Observer(Protocol):
    """Sees every accepted point."""

    def choose(self, available: Mapping[str, Variable], /) -> Sequence[str]:
        """Return the ``participant.variable`` names it wants, from those available."""

    def start(self, variables: Mapping[str, Variable], log: StepLog, /) -> None:
        """Learn what the values of `accepted` are, in order: what all observers chose.

        `log` grows with every attempt, so that a display can show counts while the run goes on.
        """

    def accepted(self, time: float, values: Vector, /) -> None:
        """See a point at `time` [s], the initial one first; `values` is reused afterwards."""

    def finished(self) -> None:
        """Learn that no point follows; also called when the run failed or was interrupted."""
