"""Measured secant stiffness of ballast over the load."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .input_tables import read_as

if TYPE_CHECKING:
    from pathlib import Path

    from track_fmu.beam_element import FloatArray


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SecantData:
    """Secant stiffness of the ballast under one rail seat, measured at several loads.

    Attributes
    ----------
    force : (n,) float array
        Largest load on the rail seat in a cycle [N], half of that on the sleeper; in any order.
    stiffness : (n,) float array
        Range of the load over range of the displacement [N/m].

    Raises
    ------
    ValueError
        For a load or a stiffness that is not above zero.
    """

    force: FloatArray
    stiffness: FloatArray

    def __post_init__(self) -> None:
        for name, values in (("force", self.force), ("stiffness", self.stiffness)):
            if np.any(values <= 0.0):
                raise ValueError(f"{name} is {values.min():g}, which must be above 0")

    @property
    def displacement(self) -> FloatArray:
        """Sleeper displacement under each load, shape (n,) [m]."""
        return self.force / self.stiffness


def read_secant_data(path: Path) -> SecantData:
    """Read a CSV file: load on a rail seat [N], secant stiffness [N/m].

    Raises
    ------
    InputError
        For a file that cannot be read or holds no such data.
    """
    return read_as(SecantData, str(path), ("force", "stiffness"))
