"""Reading what observers chose, and telling them."""

from collections.abc import Collection, Sequence

from .decision import Failure
from .exchange import Exchange
from .observers import Observer


class Observation:
    """The observed values of all participants and who wants them.

    Parameters
    ----------
    exchange : Exchange
        Participants and the flat array of observed values.
    late : collection of int
        Places of participants that step only when a step has been accepted.
    observers : sequence of Observer
        Who sees the accepted points.
    """

    def __init__(
        self, exchange: Exchange, late: Collection[int], observers: Sequence[Observer]
    ) -> None:
        self._values = exchange.observed
        watched = [(n, stage) for n, stage in enumerate(exchange.stages) if stage.observed.size]
        self._stages = [stage for n, stage in watched if n not in late]
        self._late = [stage for n, stage in watched if n in late]
        self._observers = [item.accepted for item in observers]

    def read(self, time: float, step_size: float | None = None) -> Failure | None:
        """Read the values at the end of a step from `time`, or at `time` itself [s]."""
        for stage in self._stages:
            failure = stage.read_observed(time, step_size)
            if failure is not None:
                return failure
        return None

    def read_late(self, time: float, step_size: float | None = None) -> Failure | None:
        """Do the same for participants that step late."""
        for stage in self._late:
            failure = stage.read_observed(time, step_size)
            if failure is not None:
                return failure
        return None

    def notify(self, time: float) -> None:
        """Show the values read last to everybody as those at `time` [s]."""
        for accepted in self._observers:
            accepted(time, self._values)
