"""What is given of the wheels: where they are at which time, and what they roll over."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from vehicle_fmu.speed import ConstantSpeed

from ..motion import speed_law, travel_time
from .drops import Drops
from .kinks import kinks_on_the_way

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from vehicle_fmu.speed import SpeedLaw

    from ..scenario import Scenario
    from ..surfaces.tables import UnevenSurfaces


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Course:
    """The prescribed way of all wheels over the rail.

    Attributes
    ----------
    law : SpeedLaw
        Way over time.
    starts : ndarray, shape (wheels,)
        Positions at t = 0 [m].
    surfaces : Drops
        Of treads and railhead.
    stop_time : float
        When the way is done [s].
    kinks : ndarray, shape (k,)
        Times strictly between 0 and the end at which something given is not smooth [s].
    """

    law: SpeedLaw
    starts: NDArray[np.float64]
    surfaces: Drops
    stop_time: float
    kinks: NDArray[np.float64]

    def positions(self, time: float) -> NDArray[np.float64]:
        """Return the positions of the wheels [m], shape (wheels,)."""
        return self.starts + self.law.distance(0.0, time)

    def speed(self, time: float) -> float:
        """Return the speed of all wheels [m/s]."""
        if isinstance(self.law, ConstantSpeed):
            return self.law.speed
        return float(np.interp(time, self.law.time, self.law.speed))

    def drops(self, time: float) -> NDArray[np.float64]:
        """Return what treads and railhead lie lower under each wheel [m], shape (wheels,)."""
        return self.surfaces.at(self.positions(time))


def course_of(scenario: Scenario, surfaces: UnevenSurfaces) -> Course:
    """Return the way of a scenario's wheels over its surfaces.

    Raises
    ------
    InputError
        For a table that cannot be read or does not fit.
    """
    law = speed_law(scenario.vehicle)
    starts: NDArray[np.float64] = scenario.start_position - np.array(scenario.vehicle.offsets)
    return Course(
        law=law,
        starts=starts,
        surfaces=Drops(scenario, surfaces),
        stop_time=travel_time(law, scenario.distance),
        kinks=kinks_on_the_way(scenario, surfaces, law, starts),
    )
