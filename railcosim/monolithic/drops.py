"""How much lower than a level rail and a round tread the surfaces under each wheel lie.

The profile of a flat and the tables of composed rails and treads are input, the same as the FMUs
have. How they enter is worked out here: the curves through the tables are scipy's, and so is the
way from the position of a wheel to the point of its tread.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from scipy.interpolate import PchipInterpolator

from vehicle_fmu.wheel_profile import flat_profile

from ..input_tables import read_flat

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from vehicle_fmu.irregularity import RailIrregularity
    from vehicle_fmu.out_of_roundness import OutOfRoundness

    from ..scenario import Scenario
    from ..surfaces.tables import UnevenSurfaces

    Drop = Callable[[float], float]

SEAM = 3
"""Points repeated on either side of the table of a tread, so that its curve closes smoothly."""


class Drops:
    """Drops of treads and railhead under all wheels.

    Parameters
    ----------
    scenario : Scenario
        Has the flat.
    surfaces : UnevenSurfaces
        Has the tables of rail and treads.

    Raises
    ------
    InputError
        For the table of a flat that cannot be read or does not fit.
    """

    def __init__(self, scenario: Scenario, surfaces: UnevenSurfaces) -> None:
        flat, table = read_flat(scenario)
        self._meeting, self._turn = flat.position, turn_of(scenario)
        self._wheel, self._periodic = flat.wheel - 1, flat.periodic
        self._flat: Drop | None = None
        if flat.shape != "none":
            self._flat = flat_profile(flat, table, radius=scenario.vehicle.wheel_radius)
        self._rail = None if surfaces.rail is None else _over_rail(surfaces.rail)
        self._treads = [None if tread is None else _around(tread) for tread in surfaces.treads]

    def at(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the drop under each wheel [m] at its position [m], shape (wheels,)."""
        drops = np.zeros_like(positions)
        if self._rail is not None:
            drops += [self._rail(x) for x in positions.tolist()]
        turns = (positions - self._meeting) / self._turn
        for wheel, tread in enumerate(self._treads):
            if tread is not None:
                drops[wheel] += tread(2.0 * math.pi * float(turns[wheel]))
        if self._flat is not None:
            turned = float(turns[self._wheel])
            beside = turned - round(turned) if self._periodic else turned
            drops[self._wheel] += self._flat(self._turn * beside)
        return drops


def turn_of(scenario: Scenario) -> float:
    """Return the way of a wheel over one turn [m]."""
    return 2.0 * math.pi * scenario.vehicle.wheel_radius


def _over_rail(table: RailIrregularity) -> Drop:
    """Drop of the railhead over the position [m], held at both ends of its table."""
    curve = PchipInterpolator(table.position, table.drop)
    first, last = float(table.position[0]), float(table.position[-1])
    return lambda x: float(curve(min(max(x, first), last)))


def _around(table: OutOfRoundness) -> Drop:
    """Drop of a tread over the angle that its wheel has turned since the angle zero met [rad]."""
    whole = 2.0 * math.pi
    angle = np.concatenate((table.angle[-SEAM:] - whole, table.angle, table.angle[:SEAM] + whole))
    drop = np.concatenate((table.drop[-SEAM:], table.drop, table.drop[:SEAM]))
    curve = PchipInterpolator(angle, drop)
    return lambda turned: float(curve(turned - whole * math.floor(turned / whole)))
