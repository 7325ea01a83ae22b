"""How the vehicle moves along the rail: the way travelled as an exact function of time."""

from dataclasses import dataclass, field
from typing import TypeAlias

import numpy as np

from .interpolation import PiecewiseCubic
from .validation import FloatArray, checked_table, require_positive


@dataclass(frozen=True, slots=True, kw_only=True)
class ConstantSpeed:
    """The same speed all the time.

    Attributes
    ----------
    speed : float
        Speed [m/s], above zero.

    Raises
    ------
    ValueError
        If the speed is not finite or not above zero.
    """

    speed: float

    def __post_init__(self) -> None:
        require_positive("speed", self.speed, "m/s", "the vehicle must move forwards")

    def distance(self, start: float, time: float) -> float:
        """Return the way travelled from `start` to `time` [m], both in s."""
        return self.speed * (time - start)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SpeedTable:
    """Speed on straight lines between tabulated times, constant before and after them.

    Attributes
    ----------
    time : ndarray, shape (n >= 2,)
        Times [s], strictly increasing, on the clock of the simulation.
    speed : ndarray, shape (n,)
        Speed at each time [m/s], above zero.

    Raises
    ------
    ValueError
        If the columns are no table or a speed is not above zero.
    """

    time: FloatArray
    speed: FloatArray
    _travelled: PiecewiseCubic = field(init=False, repr=False)

    def __post_init__(self) -> None:
        time, speed = checked_table(
            "speed table", ("time [s]", self.time), ("speed [m/s]", self.speed), least=2
        )
        if not (speed > 0.0).all():
            bad = int(np.flatnonzero(speed <= 0.0)[0])
            raise ValueError(
                f"speed table: the speed is {speed[bad]:g} m/s at {time[bad]:g} s; "
                "it must be above zero: the vehicle must move forwards"
            )
        object.__setattr__(self, "time", time)
        object.__setattr__(self, "speed", speed)
        travelled = np.zeros_like(time)
        travelled[1:] = np.cumsum(0.5 * (speed[:-1] + speed[1:]) * np.diff(time))
        slopes = np.column_stack((speed[:-1], speed[1:]))
        object.__setattr__(self, "_travelled", PiecewiseCubic(time, travelled, slopes))

    def distance(self, start: float, time: float) -> float:
        """Return the way travelled from `start` to `time` [m], both in s."""
        return self._from_first(time) - self._from_first(start)

    def _from_first(self, time: float) -> float:
        first, last = float(self.time[0]), float(self.time[-1])
        if time < first:
            return float(self.speed[0]) * (time - first)
        way = self._travelled(time)
        return way + float(self.speed[-1]) * (time - last) if time > last else way


SpeedLaw: TypeAlias = ConstantSpeed | SpeedTable
