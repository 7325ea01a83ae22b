"""The numbers of uneven surfaces, for programs and for the terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from rich.table import Table
from rich.text import Text

from .rail import semi_axis

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..scenario import Scenario
    from .tables import UnevenSurfaces


def surface_numbers(scenario: Scenario, surfaces: UnevenSurfaces) -> dict[str, Any]:
    """Return points, range and effective value of rail and treads, in SI units.

    The treads are by the number of the wheel; the contact patch is that under the static load.
    """
    rail = surfaces.rail
    return {
        "rail": None if rail is None else _numbers(rail.drop),
        "wheels": {
            str(number): _numbers(tread.drop)
            for number, tread in enumerate(surfaces.treads, start=1)
            if tread is not None
        },
        "contact_patch_length": 2.0 * semi_axis(scenario),
    }


def surface_report(numbers: dict[str, Any]) -> Table:
    """Lay the numbers out with the units an engineer expects."""
    patch = 1e3 * numbers["contact_patch_length"]
    table = Table(caption=f"The contact patch is {patch:.1f} mm long under the static load.")
    for heading in ("surface", "points", "smallest [um]", "largest [um]", "r.m.s. [um]"):
        table.add_column(Text(heading), justify="left" if heading == "surface" else "right")
    rows = {"rail": numbers["rail"]} | {
        f"wheel {number}": row for number, row in numbers["wheels"].items()
    }
    for name, row in rows.items():
        if row is not None:
            values = (f"{1e6 * row[key]:.1f}" for key in ("smallest", "largest", "rms"))
            table.add_row(name, str(row["points"]), *values)
    return table


def _numbers(drop: NDArray[np.float64]) -> dict[str, float]:
    return {
        "points": drop.size,
        "smallest": float(drop.min()),
        "largest": float(drop.max()),
        "rms": float(drop.std()),
    }
