"""How long the vehicle takes for its way."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import brentq

from vehicle_fmu.speed import ConstantSpeed, SpeedTable

from .input_tables import read_as

if TYPE_CHECKING:
    from vehicle_fmu.speed import SpeedLaw

    from .vehicle_section import Vehicle


def speed_law(vehicle: Vehicle) -> SpeedLaw:
    """Return the constant speed of a vehicle, or read its table.

    Raises
    ------
    InputError
        For a file that is no table of speeds above zero.
    """
    if vehicle.speed_table:
        return read_as(SpeedTable, vehicle.speed_table, ("time", "speed"))
    return ConstantSpeed(speed=vehicle.constant_speed)


def initial_speed(law: SpeedLaw) -> float:
    """Return the speed at t = 0 [m/s]."""
    if isinstance(law, ConstantSpeed):
        return law.speed
    return float(np.interp(0.0, law.time, law.speed))


def travel_time(law: SpeedLaw, distance: float) -> float:
    """Solve for the time at which ``distance`` metres have been travelled since t = 0 [s]."""
    if isinstance(law, ConstantSpeed):
        return distance / law.speed
    latest = distance / float(law.speed.min())
    latest += 1e-6 * latest  # at a constant speed rounding may leave the exact time short
    return float(brentq(lambda t: law.distance(0.0, t) - distance, 0.0, latest, xtol=1e-12))
