"""Irregularity of the railhead, tabulated along the rail."""

from dataclasses import dataclass

from .interpolation import PiecewiseCubic, monotone_curve
from .validation import FloatArray, checked_table


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RailIrregularity:
    """A table of the railhead's height error.

    Attributes
    ----------
    position : ndarray, shape (n >= 4,)
        Position along the rail [m], strictly increasing.
    drop : ndarray, shape (n,)
        How far the unloaded railhead lies too low [m]: positive downwards, a dip.

    Raises
    ------
    ValueError
        If the columns are no table.

    Notes
    -----
    Beyond its ends the table is held at its end values: the rail goes on level there. A constant
    irregularity excites nothing, so a table need not end at zero.
    """

    position: FloatArray
    drop: FloatArray

    def __post_init__(self) -> None:
        position, drop = checked_table(
            "rail irregularity", ("position [m]", self.position), ("drop [m]", self.drop), least=4
        )
        object.__setattr__(self, "position", position)
        object.__setattr__(self, "drop", drop)

    def curve(self) -> PiecewiseCubic:
        """Return the drop r(x) over the position x: a smooth monotone curve through the points."""
        return monotone_curve(self.position, self.drop)
