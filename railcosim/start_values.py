"""Start values of the FMUs of a scenario."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING, TypeAlias

from fmu_src.native.models import TRACK_CONSTANTS

from .motion import initial_speed
from .support_values import support_values
from .surfaces.files import files_of
from .suspension_section import Suspension
from .track_section import Track

if TYPE_CHECKING:
    from collections.abc import Collection

    from vehicle_fmu.speed import SpeedLaw

    from .scenario import Scenario
    from .signals import ContactSide
    from .surfaces.files import SurfaceFiles

Value: TypeAlias = float | int | bool | str
"""What a parameter of an FMU may be."""

NO_PARAMETERS = ("bays", "elements_per_bay", "supports", "supports_repeat")
"""Keys of the track that its FMU is built of, or that `_of_supports` sets."""


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
    surfaces: SurfaceFiles | None = None,
) -> dict[str, Value]:
    """Return the parameters of the track FMU, with those of the contacts if it has them.

    Those that are `fixed` in the FMU are left out. The files of uneven surfaces and of endless
    supports are those that the scenario names, or where they have to be composed, `surfaces`.
    """
    own = {name: value for name, value in _of_track(scenario).items() if name not in fixed}
    gauges = {
        f"gauge[{k}].position": position
        for k, position in enumerate(scenario.gauge_positions, start=1)
    }
    files = surfaces or files_of(scenario)
    supports = _of_supports(scenario, files)
    values = {**own, **gauges, **supports, "initial_speed": initial_speed(law)}
    if contact == "vehicle":
        return values
    values |= _contact_values(scenario, files)
    if scenario.master.algorithm == "gauss_seidel":
        values["linear_inputs"] = True  # the vehicle has stepped when the track does
    return values


def _of_supports(scenario: Scenario, files: SurfaceFiles) -> dict[str, Value]:
    """Return what supports have of their own: one by one, or as the table of an endless track."""
    if not scenario.track.endless:
        return dict(support_values(scenario))
    if not files.supports:
        return {}
    is_whole = files.supports != scenario.track.supports
    return {
        "supports": files.supports,
        "supports_repeat": scenario.track.supports_repeat and not is_whole,
    }


def vehicle_values(
    scenario: Scenario,
    law: SpeedLaw,
    contact: ContactSide = "vehicle",
    *,
    surfaces: SurfaceFiles | None = None,
) -> dict[str, Value]:
    """Return the parameters of the vehicle FMU, with those of the contacts if it has them.

    For `surfaces` see `track_values`.
    """
    vehicle = scenario.vehicle
    motion: dict[str, Value] = {
        "speed": initial_speed(law),
        "speed_table": vehicle.speed_table,
        "initial_position": scenario.start_position,
        "wheel_mass": vehicle.wheel_mass,
        "static_wheel_load": vehicle.static_wheel_load,
    }
    offsets = {
        f"wheel[{k}].offset": offset for k, offset in enumerate(vehicle.offsets[1:], start=2)
    }
    values = {**motion, **offsets, **_suspension_values(scenario)}
    return (
        values
        if contact == "track"
        else values | _contact_values(scenario, surfaces or files_of(scenario))
    )


def _suspension_values(scenario: Scenario) -> dict[str, Value]:
    """Return the parameters of the bodies above the wheels; all bogies are alike."""
    values: dict[str, Value] = {"model": scenario.vehicle.model}
    for item in fields(Suspension):
        value = getattr(scenario.suspension, item.name)
        part, _, name = item.name.partition("_")
        if part == "bogie":
            bogies = range(1, scenario.vehicle.bogies + 1)
            values |= {f"bogie[{j}].{name}": value for j in bogies}
        else:
            values[f"{part}.{name}"] = value
    return values


def _contact_values(scenario: Scenario, surfaces: SurfaceFiles) -> dict[str, Value]:
    """Return the parameters of contacts and surfaces, on either side."""
    vehicle, flat = scenario.vehicle, scenario.flat
    return {
        "static_wheel_load": vehicle.static_wheel_load,
        "wheel_radius": vehicle.wheel_radius,
        "hertz_coefficient": vehicle.hertz_coefficient,
        "rail_irregularity": surfaces.rail,
        "flat.shape": flat.shape,
        "flat.length": flat.length,
        "flat.depth": flat.depth,
        "flat.wheel": flat.wheel,
        "flat.position": scenario.flat_position,
        "flat.periodic": flat.periodic,
        "flat.rolled": flat.rolled,
        **{f"wheel[{k}].out_of_roundness": path for k, path in enumerate(surfaces.treads, start=1)},
    }
