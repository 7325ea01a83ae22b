"""Out-of-roundness of a wheel, tabulated around its tread."""

import math
from dataclasses import dataclass

from .interpolation import periodic_monotone_curve
from .validation import FloatArray, checked_table
from .wheel_profile import Profile

FULL_TURN = 2.0 * math.pi


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class OutOfRoundness:
    """A table of the tread's error in radius over one turn.

    Attributes
    ----------
    angle : ndarray, shape (n >= 4,)
        Angle around the wheel [rad], strictly increasing in the order in which the tread meets
        the rail, from 0 to below 2 pi.
    drop : ndarray, shape (n,)
        How far the tread lies below its round shape there [m]: positive where metal is missing.

    Raises
    ------
    ValueError
        If the columns are no table or leave one turn of the wheel.

    Notes
    -----
    The tread closes: behind the last point comes the first one again, a whole turn further on.
    """

    angle: FloatArray
    drop: FloatArray

    def __post_init__(self) -> None:
        angle, drop = checked_table(
            "out-of-roundness", ("angle [rad]", self.angle), ("drop [m]", self.drop), least=4
        )
        if not (angle[0] >= 0.0 and angle[-1] < FULL_TURN):
            raise ValueError(
                f"out-of-roundness: the angle goes from {angle[0]:g} to {angle[-1]:g} rad; it must "
                "be at least 0 and below 2 pi: give radians, and leave out a last point that is "
                "the first one again"
            )
        object.__setattr__(self, "angle", angle)
        object.__setattr__(self, "drop", drop)

    def curve(self) -> Profile:
        """Return the drop over the angle [rad]: a smooth monotone curve, again after every turn."""
        return tread_along_rail(self, position=0.0, radius=1.0)


def tread_along_rail(table: OutOfRoundness, *, position: float, radius: float) -> Profile:
    """Return the drop over the position x of the wheel along the rail.

    Parameters
    ----------
    table : OutOfRoundness
        The tread; a smooth monotone curve goes through its points.
    position : float
        Where the angle zero meets the rail [m]; so it does again every 2 pi R.
    radius : float
        Wheel radius R [m].
    """
    turn = FULL_TURN * radius
    curve = periodic_monotone_curve(radius * table.angle, table.drop, turn)
    first = radius * float(table.angle[0])

    def drop(x: float) -> float:
        s = x - position - first
        return curve(first + (s - turn * math.floor(s / turn)))

    return drop
