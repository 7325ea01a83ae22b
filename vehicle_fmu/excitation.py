"""What the wheels roll over: tread and railhead drops under each wheel at the stage times."""

from collections.abc import Sequence
from functools import cached_property

from .integration import substeps_of
from .irregularity import RailIrregularity
from .out_of_roundness import OutOfRoundness
from .parameters import FlatParameters, VehicleParameters
from .speed import SpeedLaw
from .surfaces import surface_profiles
from .wheel_profile import Profile, WheelProfileTable


class Excitation:
    """The drops p(x) + r(x) of all wheels as functions of time.

    Parameters
    ----------
    parameters : VehicleParameters
        Start position, wheel offsets, wheel radius and longest substep.
    flat, flat_table, irregularity, out_of_roundness, speed
        As for `VehicleModel`, already checked.

    Notes
    -----
    Every result depends on its arguments alone. The drops of the last step are kept, because a
    master that iterates asks for the same step over and over.
    """

    def __init__(
        self,
        parameters: VehicleParameters,
        *,
        flat: FlatParameters,
        flat_table: WheelProfileTable | None,
        irregularity: RailIrregularity | None,
        out_of_roundness: Sequence[OutOfRoundness | None],
        speed: SpeedLaw,
    ) -> None:
        self._parameters = parameters
        self._flat = flat
        self._flat_table = flat_table
        self._irregularity = irregularity
        self._out_of_roundness = tuple(out_of_roundness)
        self._speed = speed
        self._lags = parameters.offsets
        self._last_step: tuple[float, float, float] | None = None
        self._last_drops: list[list[float]] = []

    def positions(self, start: float, time: float) -> list[float]:
        """Return the position of each wheel along the rail at `time` after the start time [m]."""
        leading = self._leading_position(start, time)
        return [leading - lag for lag in self._lags]

    def drops(self, start: float, time: float) -> list[float]:
        """Return the drop under each wheel at `time` [m]."""
        positions = self.positions(start, time)
        return [profile(x) for profile, x in zip(self._profiles, positions, strict=True)]

    def rates(self, start: float, span: float) -> list[float]:
        """Return how fast the drop under each wheel grows at the start time [m/s].

        The mean over a span [s], half of it before the start time and half after.
        """
        before, after = (self.drops(start, start + sign * 0.5 * span) for sign in (-1.0, 1.0))
        return [(b - a) / span for a, b in zip(before, after, strict=True)]

    def drops_over_step(self, start: float, time: float, step_size: float) -> list[list[float]]:
        """Return the drops at start, middle and end of each of the n equal substeps of a step.

        Parameters
        ----------
        start, time, step_size : float
            Start time of the simulation, start of the step, its length [s].

        Returns
        -------
        list of list of float
            For each wheel 2 n + 1 drops [m], the last one exactly that of `drops` at the end.
            They are kept for the next call: not to be changed.
        """
        step = (start, time, step_size)
        if step != self._last_step:
            halves = 2 * substeps_of(step_size, self._parameters.substep)
            times = [time + k * step_size / halves for k in range(halves)]
            leading = [self._leading_position(start, t) for t in (*times, time + step_size)]
            self._last_drops = [
                [profile(x - lag) for x in leading]
                for profile, lag in zip(self._profiles, self._lags, strict=True)
            ]
            self._last_step = step
        return self._last_drops

    def _leading_position(self, start: float, time: float) -> float:
        return self._parameters.initial_position + self._speed.distance(start, time)

    @cached_property
    def _profiles(self) -> list[Profile]:
        """The sum of tread and railhead drop over the position, for each wheel.

        Built at first use: a rolled flat takes some 20 ms.
        """
        return surface_profiles(
            self._flat,
            self._flat_table,
            self._irregularity,
            out_of_roundness=self._out_of_roundness,
            wheels=self._parameters.wheels,
            radius=self._parameters.wheel_radius,
        )
