"""The vehicle of a scenario."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from vehicle_fmu.suspension_parameters import GRAVITY

from .springs import Spring
from .sprung_vehicle import SprungVehicle, Superstructure, Wheelset
from .vehicle import RigidWheels

if TYPE_CHECKING:
    from ..scenario import Scenario
    from ..suspension_section import Suspension
    from .vehicle import Vehicle


def vehicle_of(scenario: Scenario) -> Vehicle:
    """Return the vehicle of a scenario: masses, or bodies on springs."""
    vehicle, keys = scenario.vehicle, scenario.suspension
    if keys.tread_mass == 0.0 and not vehicle.is_suspended:
        return RigidWheels(vehicle.wheels, vehicle.wheel_mass)
    wheelset = Wheelset(tread=vehicle.wheel_mass)
    if keys.tread_mass > 0.0:
        wheelset = Wheelset(
            tread=keys.tread_mass,
            hub=vehicle.wheel_mass - keys.tread_mass,
            spring=Spring(stiffness=keys.tread_stiffness, damping=keys.tread_damping),
        )
    above = _superstructure(scenario) if vehicle.is_suspended else None
    return SprungVehicle(vehicle.wheels, wheelset, above)


def _superstructure(scenario: Scenario) -> Superstructure:
    """Bogies and car body, with what they carry; the car has the mass that is left without one."""
    vehicle, keys = scenario.vehicle, scenario.suspension
    bogies, share = vehicle.bogies, vehicle.wheels // vehicle.bogies
    lags = np.array(vehicle.offsets).reshape(bogies, share)
    middles = lags.mean(axis=1)
    on_wheel = vehicle.static_wheel_load - GRAVITY * vehicle.wheel_mass
    on_bogie = share * on_wheel - GRAVITY * keys.bogie_mass
    return Superstructure(
        bogie_mass=keys.bogie_mass,
        bogie_inertia=keys.bogie_pitch_inertia,
        car_mass=keys.car_mass or bogies * on_bogie / GRAVITY,
        car_inertia=keys.car_pitch_inertia,
        levers=middles[:, None] - lags,
        car_levers=middles.mean() - middles,
        primary=_spring(keys, "primary"),
        secondary=_spring(keys, "secondary"),
        primary_load=on_wheel,
        secondary_load=on_bogie,
    )


def _spring(keys: Suspension, stage: str) -> Spring:
    names = ("stiffness", "damping", "rebound_ratio", "clearance", "stop_stiffness")
    return Spring(**{name: getattr(keys, f"{stage}_{name}") for name in names})
