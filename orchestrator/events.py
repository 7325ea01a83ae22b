"""Switches of signed indicators: their sides, and the attempts that land on a change of side."""

from collections import deque
from collections.abc import Sequence
from math import inf

from .accumulation import GeometricIntervals
from .bracket import Bracket, Point, most_others
from .decision import Landed, Refine
from .errors import ZenoError
from .outcome import Switch


class Switches:
    """Sides of all indicators at the accepted point, and the bracket of a switch being located.

    An indicator has a side, +1 or -1, which changes only when an accepted step ends on a switch. A
    step has met a switch when an indicator ends on the other side by more than the tolerance.

    Parameters
    ----------
    names : sequence of str
        Indicators, as ``participant.variable``.
    tolerance : float
        Values of an indicator up to this count as zero, in its unit.
    time_tolerance : float
        Width of a bracket that locates a switch well enough [s].
    limit : int
        Number of switches allowed within `window`.
    window : float
        Span of time [s].
    accumulation_share : float
        Time left before switches accumulate, over the time they took so far, at which they are
        taken to do so.
    stop_time : float
        End of the run [s]: switches that accumulate later do no harm.
    """

    def __init__(
        self,
        names: Sequence[str],
        *,
        tolerance: float,
        time_tolerance: float,
        limit: int,
        window: float,
        accumulation_share: float = 1e-3,
        stop_time: float = inf,
    ) -> None:
        self.names = tuple(names)
        self.found: list[Switch] = []
        self._tolerance = tolerance
        self._time_tolerance = time_tolerance
        self._limit = limit
        self._window = window
        self._recent: deque[float] = deque(maxlen=limit)
        self._stop_time = stop_time
        self._series = {
            (place, positive): GeometricIntervals(accumulation_share)
            for place in range(len(self.names))
            for positive in (False, True)
        }
        self._sides: list[int] = []
        self._at_rest: list[bool] = []
        self._values: tuple[float, ...] = ()
        self._before: tuple[Point, ...] = ()
        self._bracket: Bracket | None = None
        self._tried: Bracket | None = None

    @property
    def values(self) -> tuple[float, ...]:
        """Indicators at the accepted point."""
        return self._values

    @property
    def searching(self) -> bool:
        """Whether attempts are made to land on a switch."""
        return self._bracket is not None

    def start(self, values: Sequence[float]) -> None:
        """Take the sides from the initial values; one that is zero takes its side on leaving."""
        self._sides = [0] * len(values)
        self._at_rest = [True] * len(values)
        self._bracket = None
        self._settle(values)

    def examine(self, step_size: float, values: Sequence[float]) -> Refine | Landed | None:
        """Say whether an attempt met a switch; nothing is remembered until it is decided on.

        Parameters
        ----------
        step_size : float
            Size of the attempt [s].
        values : sequence of float
            Indicators at its end.
        """
        signed = self._signed(values)
        crossed = tuple(n for n, value in enumerate(signed) if value < -self._tolerance)
        bracket = self._bracket
        if not crossed:
            landed = tuple(
                n
                for n, value in enumerate(signed)
                if value <= self._tolerance and not self._at_rest[n]
            )
            if landed:
                return Landed(landed)
            if bracket is None:
                return None
        point = (step_size, signed)
        if bracket is None:
            before = tuple((size, self._signed(old)) for size, old in self._before)
            bracket = Bracket((0.0, self._signed(self._values)), point, before)
        else:
            bracket = bracket.narrowed(point, crossed=bool(crossed))
        if bracket.width <= self._time_tolerance and crossed:
            return Landed(crossed)
        self._tried = bracket
        if bracket.width <= self._time_tolerance:
            return Refine(bracket.high[0], crossed=False)
        size = bracket.next_size(
            tolerance=self._tolerance,
            at_rest=tuple(self._at_rest),
            margin=0.5 * self._time_tolerance,
        )
        return Refine(size, bool(crossed))

    def narrow(self) -> None:
        """Keep the bracket of the attempt just examined: the search goes on."""
        self._bracket = self._tried

    def abandon(self) -> None:
        """Give up the search: the next attempt is unrelated to it."""
        self._bracket = None

    def accept(
        self, time: float, step_size: float, values: Sequence[float], finding: Landed | None
    ) -> None:
        """Move on to an accepted point and change the sides found to change there.

        Raises
        ------
        ZenoError
            When too many switches follow one another, or their intervals shrink to nothing.
        """
        self._bracket = None
        before = [(0.0, self._values), *self._before][:most_others]
        self._before = tuple((size - step_size, old) for size, old in before)
        self._values = tuple(values)
        if finding is not None:
            self._before = ()
            for place in finding.switched:
                self._switch(time, place)
        self._settle(values)

    def count(self, time: float, what: str) -> None:
        """Count something that may happen without end, at `time` [s].

        Raises
        ------
        ZenoError
            When it happens too often.
        """
        if len(self._recent) == self._limit and time - self._recent[0] < self._window:
            raise ZenoError(
                f"{what} {self._limit + 1} times within {self._window:.3g} s up to "
                f"t = {time:.9g} s, which looks like no end of it; "
                "change the model or allow more switches in the settings."
            )
        self._recent.append(time)

    def _switch(self, time: float, place: int) -> None:
        self._sides[place] = -self._sides[place]
        self._at_rest[place] = True
        name, positive = self.names[place], self._sides[place] > 0
        self.found.append(Switch(time=time, indicator=name, positive=positive))
        end = self._series[place, positive].add(time)
        if end is not None and end <= self._stop_time:
            raise ZenoError(
                f"{name} switches at ever shorter intervals, the last ones before "
                f"t = {time:.9g} s, which accumulate at t = {end:.9g} s, and nothing can be "
                "simulated beyond; let the model come to rest there, give its contact a "
                "stiffness, or stop before."
            )
        self.count(time, f"{name} and others switched")

    def _settle(self, values: Sequence[float]) -> None:
        self._values = tuple(values)
        for place, value in enumerate(values):
            if abs(value) > self._tolerance:
                self._at_rest[place] = False
                if self._sides[place] == 0:
                    self._sides[place] = 1 if value > 0.0 else -1

    def _signed(self, values: Sequence[float]) -> tuple[float, ...]:
        return tuple(
            side * value if side else abs(value)
            for side, value in zip(self._sides, values, strict=True)
        )
