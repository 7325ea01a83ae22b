"""Start values of the FMUs of a scenario."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING, TypeAlias

from fmu_src.native.models import TRACK_CONSTANTS

from .motion import initial_speed
from .sections import Track
from .support_values import support_values

if TYPE_CHECKING:
    from collections.abc import Collection

    from vehicle_fmu.speed import SpeedLaw

    from .scenario import Scenario
    from .signals import ContactSide

Value: TypeAlias = float | int | bool | str
"""What a parameter of an FMU may be."""

NO_PARAMETERS = ("bays", "elements_per_bay", "supports")
"""Keys of the track that its FMU is built of, or that are parameters of its supports."""


def track_constants(scenario: Scenario) -> dict[str, Value]:
    """Return the parameters of the track FMU that its modes depend on."""
    return {name: value for name, value in _of_track(scenario).items() if name in TRACK_CONSTANTS}


def _of_track(scenario: Scenario) -> dict[str, Value]:
    own = {
        item.name: getattr(scenario.track, item.name)
        for item in fields(Track)
        if item.name not in NO_PARAMETERS
    }
    return own | {"mode_pairs": scenario.track.retained_pairs}


def track_values(
    scenario: Scenario,
    law: SpeedLaw,
    contact: ContactSide = "vehicle",
    *,
    fixed: Collection[str] = (),
) -> dict[str, Value]:
    """Return the parameters of the track FMU, with those of the contacts if it has them.

    Those that are `fixed` in the FMU are left out.
    """
    own = {name: value for name, value in _of_track(scenario).items() if name not in fixed}
    gauges = {
        f"gauge[{k}].position": position
        for k, position in enumerate(scenario.gauge_positions, start=1)
    }
    values = {**own, **gauges, **support_values(scenario), "initial_speed": initial_speed(law)}
    if contact == "vehicle":
        return values
    values |= _contact_values(scenario)
    if scenario.master.algorithm == "gauss_seidel":
        values["linear_inputs"] = True  # the vehicle has stepped when the track does
    return values


def vehicle_values(
    scenario: Scenario, law: SpeedLaw, contact: ContactSide = "vehicle"
) -> dict[str, Value]:
    """Return the parameters of the vehicle FMU, with those of the contacts if it has them."""
    vehicle = scenario.vehicle
    motion: dict[str, Value] = {
        "speed": initial_speed(law),
        "speed_table": vehicle.speed_table,
        "initial_position": scenario.start_position,
        "wheel_mass": vehicle.wheel_mass,
        "static_wheel_load": vehicle.static_wheel_load,
    }
    if contact == "vehicle":
        return {**motion, "axle_base": vehicle.axle_base, **_contact_values(scenario)}
    offsets = {f"wheel[{k + 1}].offset": k * vehicle.axle_base for k in range(1, vehicle.wheels)}
    return {**motion, **offsets}


def _contact_values(scenario: Scenario) -> dict[str, Value]:
    """Return the parameters of contacts and surfaces, on either side."""
    vehicle, flat = scenario.vehicle, scenario.flat
    return {
        "static_wheel_load": vehicle.static_wheel_load,
        "wheel_radius": vehicle.wheel_radius,
        "hertz_coefficient": vehicle.hertz_coefficient,
        "rail_irregularity": vehicle.rail_irregularity,
        "flat.shape": flat.shape,
        "flat.length": flat.length,
        "flat.depth": flat.depth,
        "flat.wheel": flat.wheel,
        "flat.position": scenario.flat_position,
        "flat.periodic": flat.periodic,
        "flat.rolled": flat.rolled,
    }
