"""Time histories of a passage on a uniform grid of distances, which all cases have in common."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..errors import InputError
from ..signals import SIGNALS

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

    from ..sections import Run

KEPT = {signal.name: signal for signal in SIGNALS if signal.name != "in_contact"}
"""Signals that can be kept: those with values between two points; the gap tells of contact."""

FINEST = 1e-5
"""Smallest spacing of the grid [m]: the distance rolled in a microsecond at 36 km/h."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Keep:
    """Keys of ``[keep]``: which histories every case keeps.

    Attributes
    ----------
    signals : tuple of str
        Names of `SIGNALS`, but for ``in_contact``.
    spacing : float
        Distance of neighbouring points [m]; the points are whole multiples of it, 0 where the
        flat's centre meets the rail.

    Raises
    ------
    InputError
        For another signal, or a spacing that is none.
    """

    signals: tuple[str, ...]
    spacing: float

    def __post_init__(self) -> None:
        unknown = [name for name in self.signals if name not in KEPT]
        if unknown or not self.signals:
            raise InputError(
                f"keep.signals is {list(self.signals)} but must name some of {', '.join(KEPT)}"
            )
        if len(set(self.signals)) < len(self.signals):
            raise InputError(f"keep.signals is {list(self.signals)}: name every signal once")
        number = isinstance(self.spacing, (int, float)) and not isinstance(self.spacing, bool)
        if not (number and math.isfinite(self.spacing) and self.spacing >= FINEST):
            raise InputError(
                f"keep.spacing is {self.spacing!r} but must be a distance of at least {FINEST:g} m"
            )

    def grid(self, start: float, end: float) -> tuple[int, int]:
        """Return the first multiple of the spacing in an interval and the one after its last.

        Parameters
        ----------
        start, end : float
            The interval [m].
        """
        margin = 1e-9  # of the spacing: 0.3 is the third multiple of 0.1
        first = math.ceil(start / self.spacing - margin)
        return first, math.floor(end / self.spacing + margin) + 1


def reduce(passage: xr.Dataset, keep: Keep, run: Run) -> dict[str, NDArray[np.float64]]:
    """Interpolate the kept signals between the accepted points.

    Parameters
    ----------
    passage : xarray.Dataset
        Result of a passage.
    keep : Keep
        Which signals, and where.
    run : Run
        The distance rolled.

    Returns
    -------
    dict of str to ndarray, shape (points, wheels or sleepers or gauges)
        The signals by name; ``first``, an integer, is the multiple of the spacing that the first
        point is.
    """
    first, after = keep.grid(-run.approach, run.departure)
    points = keep.spacing * np.arange(first, after)
    distance = passage["distance"].to_numpy()
    reduced = {
        name: np.stack(
            [np.interp(points, distance, column) for column in passage[name].to_numpy().T], axis=1
        )
        for name in keep.signals
    }
    return {"first": np.array(first), **reduced}
