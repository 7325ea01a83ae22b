"""The section of a scenario file about the bodies above the wheels, and flexible wheelsets."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from vehicle_fmu.suspended_masses import SUBSTEP
from vehicle_fmu.suspension import Suspension as CoupledBodies
from vehicle_fmu.suspension_parameters import (
    PRIMARY,
    SECONDARY,
    BodyParameters,
    SuspensionElement,
    Tread,
)

from .errors import InputError
from .field_rules import Number
from .fields import check_fields

if TYPE_CHECKING:
    from .vehicle_section import Vehicle

BODIES = BodyParameters()

KEYS = {
    "static_wheel_load": "vehicle.axle_load_t",
    "wheel_mass": "vehicle.wheel_mass",
    "tread.mass": "suspension.tread_mass",
}
"""Keys of a scenario for the parameters of an FMU that the models' messages name."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Suspension:
    """Keys of ``[suspension]``: half a vehicle, over one of its rails.

    All but the tread matter only with ``vehicle.model = "suspended"``. The defaults are those of
    the passenger coach of Iwnicki, Vehicle System Dynamics 30 (1998) 295-313.

    Attributes
    ----------
    tread_mass, tread_stiffness, tread_damping : float
        Part of ``vehicle.wheel_mass`` that the rim of a flexible wheelset has [kg], and what
        joins it to the hub [N/m], [N s/m]; a mass of 0 is a rigid wheelset.
    primary_stiffness, primary_damping : float
        Primary suspension of a wheel [N/m], [N s/m] in compression.
    primary_rebound_ratio : float
        Its damping in extension over that in compression.
    primary_clearance, primary_stop_stiffness : float
        Compression from static equilibrium at which its bump stop is met [m], and how much that
        adds to the stiffness [N/m].
    secondary_stiffness, ... : float
        The same of the secondary suspension of a bogie.
    bogie_mass, bogie_pitch_inertia : float
        Of half a bogie frame [kg], [kg m2].
    car_mass : float
        Of half the car body [kg]; 0: what the axle loads leave.
    car_pitch_inertia : float
        Of half the car body [kg m2].
    """

    tread_mass: Annotated[float, Number(unit="kg", at_least=0.0)] = 0.0
    tread_stiffness: Annotated[float, Number(unit="N/m", at_least=0.0)] = 0.0
    tread_damping: Annotated[float, Number(unit="N s/m", at_least=0.0)] = 0.0
    primary_stiffness: Annotated[float, Number(unit="N/m", at_least=0.0)] = PRIMARY.stiffness
    primary_damping: Annotated[float, Number(unit="N s/m", at_least=0.0)] = PRIMARY.damping
    primary_rebound_ratio: Annotated[float, Number(at_least=0.0)] = 1.0
    primary_clearance: Annotated[float, Number(unit="m")] = 0.0
    primary_stop_stiffness: Annotated[float, Number(unit="N/m", at_least=0.0)] = 0.0
    secondary_stiffness: Annotated[float, Number(unit="N/m", at_least=0.0)] = SECONDARY.stiffness
    secondary_damping: Annotated[float, Number(unit="N s/m", at_least=0.0)] = SECONDARY.damping
    secondary_rebound_ratio: Annotated[float, Number(at_least=0.0)] = 1.0
    secondary_clearance: Annotated[float, Number(unit="m")] = 0.0
    secondary_stop_stiffness: Annotated[float, Number(unit="N/m", at_least=0.0)] = 0.0
    bogie_mass: Annotated[float, Number(unit="kg", above=0.0)] = BODIES.bogie_mass[0]
    bogie_pitch_inertia: Annotated[float, Number(unit="kg m2", above=0.0)] = (
        BODIES.bogie_pitch_inertia[0]
    )
    car_mass: Annotated[float, Number(unit="kg", at_least=0.0)] = BODIES.car_mass
    car_pitch_inertia: Annotated[float, Number(unit="kg m2", above=0.0)] = BODIES.car_pitch_inertia

    def __post_init__(self) -> None:
        check_fields(self, "suspension")


def check_bodies(vehicle: Vehicle, suspension: Suspension) -> None:
    """Refuse bodies that the axle loads cannot carry, or a tread that its wheel cannot hold.

    Raises
    ------
    InputError
        In a sentence.
    """
    try:
        CoupledBodies(
            offsets=vehicle.offsets,
            wheel_mass=vehicle.wheel_mass,
            load=vehicle.static_wheel_load,
            tread=_tread(suspension),
            bogies=vehicle.bogies,
            bodies=_bodies(suspension, vehicle.bogies) if vehicle.is_suspended else None,
        ).check_substep(SUBSTEP)
    except ValueError as error:
        sentence = str(error)
        for parameter, key in KEYS.items():
            sentence = sentence.replace(parameter, key)
        raise InputError(f"vehicle and suspension do not fit together: {sentence}") from error


def _tread(suspension: Suspension) -> Tread | None:
    if suspension.tread_mass == 0.0:
        return None
    return Tread(
        mass=suspension.tread_mass,
        stiffness=suspension.tread_stiffness,
        damping=suspension.tread_damping,
    )


def _bodies(suspension: Suspension, bogies: int) -> BodyParameters:
    return BodyParameters(
        bogie_mass=(suspension.bogie_mass,) * bogies,
        bogie_pitch_inertia=(suspension.bogie_pitch_inertia,) * bogies,
        car_mass=suspension.car_mass,
        car_pitch_inertia=suspension.car_pitch_inertia,
        primary=SuspensionElement(
            stiffness=suspension.primary_stiffness,
            damping=suspension.primary_damping,
            rebound_ratio=suspension.primary_rebound_ratio,
            clearance=suspension.primary_clearance,
            stop_stiffness=suspension.primary_stop_stiffness,
        ),
        secondary=SuspensionElement(
            stiffness=suspension.secondary_stiffness,
            damping=suspension.secondary_damping,
            rebound_ratio=suspension.secondary_rebound_ratio,
            clearance=suspension.secondary_clearance,
            stop_stiffness=suspension.secondary_stop_stiffness,
        ),
    )
