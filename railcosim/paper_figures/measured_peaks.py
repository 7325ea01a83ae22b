"""Measured peak values over the speed of the train, from the user's tables."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..input_tables import read_as

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MeasuredPeaks:
    """Peak values of measured passages.

    Attributes
    ----------
    speed : ndarray, shape (n,)
        Of every passage [km/h], in any order.
    contact_force : ndarray, shape (n,)
        Peak wheel-rail contact force [N].
    bending_moment : ndarray, shape (n,), optional
        Peak bending moment of the rail in the middle of the struck bay [N m].
    name : str
        What the points are called in figures.

    Raises
    ------
    ValueError
        For a speed that is not above zero.
    """

    speed: NDArray[np.float64]
    contact_force: NDArray[np.float64]
    bending_moment: NDArray[np.float64] | None = None
    name: str = "measured"

    def __post_init__(self) -> None:
        if (self.speed <= 0.0).any():
            raise ValueError(
                f"the speed is {self.speed.min():g} km/h but must be above 0 km/h: drop that line"
            )


def read_measured_peaks(path: Path) -> MeasuredPeaks:
    """Read a table with the columns speed [km/h], contact force [N], bending moment [N m].

    The last column may be missing.

    Raises
    ------
    InputError
        For a file that is no such table.
    """

    def named(
        speed: NDArray[np.float64],
        contact_force: NDArray[np.float64],
        bending_moment: NDArray[np.float64] | None = None,
    ) -> MeasuredPeaks:
        return MeasuredPeaks(
            speed=speed,
            contact_force=contact_force,
            bending_moment=bending_moment,
            name=f"measured ({path.stem})",
        )

    columns = ("speed", "contact_force")
    return read_as(named, str(path), columns, optional=("bending_moment",))
