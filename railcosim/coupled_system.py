"""A scenario as a co-simulation: start values of the FMUs, connections, settings of the master."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING, TypeAlias, cast

from orchestrator import Connection, FmuSource, MasterSettings, System

from .motion import initial_speed
from .sections import Track

if TYPE_CHECKING:
    from collections.abc import Iterable
    from typing import Literal

    from build_fmus import FmuPaths
    from vehicle_fmu.speed import SpeedLaw

    from .scenario import Scenario

Value: TypeAlias = float | int | bool | str
"""What a parameter of an FMU may be."""

BUILT_IN = ("bays", "elements_per_bay")
"""Keys of the track that are fixed when its FMU is built."""

SMALLEST_DIVISION = 1e-4
"""How far a failing step of fixed size may be divided, where the scenario does not say."""


def connect(
    scenario: Scenario, paths: FmuPaths, law: SpeedLaw, *, timeout: float | None = None
) -> System:
    """Join track and vehicle; see `fmu_sources`.

    Raises
    ------
    orchestrator.errors.InputError
        For an FMU that is missing, corrupt or another one.
    """
    sources = fmu_sources(scenario, paths, law, timeout=timeout)
    return join(sources, scenario.vehicle.wheels)


def join(sources: Iterable[FmuSource], wheels: int) -> System:
    """Open the FMUs and connect them over so many wheels."""
    return System([source.open() for source in sources], connections(wheels))


def fmu_sources(
    scenario: Scenario, paths: FmuPaths, law: SpeedLaw, *, timeout: float | None = None
) -> tuple[FmuSource, FmuSource]:
    """Name the FMUs and their start values.

    Parameters
    ----------
    scenario : Scenario
        Gives the start values.
    paths : FmuPaths
        FMUs of the scenario's size.
    law : SpeedLaw
        Speed of the vehicle.
    timeout : float, optional
        Longest answer of an FMU to one call [s], each FMU then being in a process of its own.

    Returns
    -------
    tuple of FmuSource
        The vehicle and the track.
    """
    return (
        FmuSource(
            path=paths.vehicle,
            name="vehicle",
            start_values=vehicle_values(scenario, law),
            timeout=timeout,
        ),
        FmuSource(
            path=paths.track,
            name="track",
            start_values=track_values(scenario, law),
            timeout=timeout,
        ),
    )


def connections(wheels: int) -> list[Connection]:
    """Return positions and forces to the track, and rail displacements back."""
    return [
        Connection(
            source=f"{source}.wheel[{k}].{name}",
            target=f"{target}.wheel[{k}].{name}",
        )
        for k in range(1, wheels + 1)
        for source, target, name in (
            ("vehicle", "track", "position"),
            ("vehicle", "track", "contact_force"),
            ("track", "vehicle", "rail_displacement"),
        )
    ]


def indicators(wheels: int) -> list[str]:
    """Name the signed gaps, whose changes of sign are switches of contact."""
    return [f"vehicle.wheel[{k}].gap" for k in range(1, wheels + 1)]


def track_values(scenario: Scenario, law: SpeedLaw) -> dict[str, Value]:
    """Return the parameters of the track FMU."""
    own = {
        item.name: getattr(scenario.track, item.name)
        for item in fields(Track)
        if item.name not in BUILT_IN
    }
    own["mode_pairs"] = scenario.track.retained_pairs
    gauges = {
        f"gauge[{k}].position": position
        for k, position in enumerate(scenario.gauge_positions, start=1)
    }
    return {**own, **gauges, "initial_speed": initial_speed(law)}


def vehicle_values(scenario: Scenario, law: SpeedLaw) -> dict[str, Value]:
    """Return the parameters of the vehicle FMU."""
    vehicle, flat = scenario.vehicle, scenario.flat
    return {
        "speed": initial_speed(law),
        "speed_table": vehicle.speed_table,
        "initial_position": scenario.start_position,
        "wheel_mass": vehicle.wheel_mass,
        "static_wheel_load": vehicle.static_wheel_load,
        "axle_base": vehicle.axle_base,
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


def master_settings(scenario: Scenario) -> MasterSettings:
    """Return the settings of the master: a fixed step if the scenario has one, or error control."""
    keys = scenario.master
    algorithm = cast("Literal['newton', 'gauss_seidel', 'jacobi']", keys.algorithm)
    if keys.step is not None:
        return MasterSettings(
            algorithm=algorithm,
            tolerance=None,
            fixed_step=keys.step,
            min_step=keys.min_step or SMALLEST_DIVISION * keys.step,
            coupling_tolerance=keys.coupling_tolerance,
            max_iterations=keys.max_iterations,
            max_rejections=keys.max_rejections,
        )
    return MasterSettings(
        algorithm=algorithm,
        tolerance=keys.tolerance,
        initial_step=keys.initial_step or keys.min_step,
        min_step=keys.min_step,
        max_step=keys.largest_step,
        coupling_tolerance=keys.coupling_tolerance,
        max_iterations=keys.max_iterations,
        max_rejections=keys.max_rejections,
    )
