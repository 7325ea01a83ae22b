"""A scenario as a co-simulation: the FMUs, their connections, the settings of the master."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, cast

from orchestrator import Connection, FmuSource, MasterSettings, System

from .start_values import track_values, vehicle_values

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from typing import Literal

    from fmu_src.building import FmuPaths
    from vehicle_fmu.speed import SpeedLaw

    from .scenario import Scenario
    from .signals import ContactSide
    from .surfaces.files import SurfaceFiles

EXPLICIT_STEP = 1e-4
"""Step with contact on the track side, where the scenario leaves algorithm and step open [s]."""

SMALLEST_DIVISION = 1e-4
"""How far a failing step of fixed size may be divided, where the scenario does not say."""


EXCHANGED: Mapping[ContactSide, tuple[tuple[str, str, str], ...]] = {
    "vehicle": (
        ("vehicle", "track", "position"),
        ("vehicle", "track", "contact_force"),
        ("track", "vehicle", "rail_displacement"),
    ),
    "track": (
        ("vehicle", "track", "position"),
        ("vehicle", "track", "displacement"),
        ("track", "vehicle", "contact_force"),
    ),
}
"""From where to where which quantity of every wheel goes."""

EXCHANGED_AT_START: tuple[tuple[str, str, str], ...] = (
    ("track", "vehicle", "static_displacement"),
    ("track", "vehicle", "static_velocity"),
    ("track", "vehicle", "mean_velocity"),
    ("vehicle", "track", "velocity"),
    ("vehicle", "track", "load_change"),
)
"""Likewise, what vehicle and track with the contacts settle during the initialisation only."""


def join(
    sources: Iterable[FmuSource], scenario: Scenario, contact: ContactSide = "vehicle"
) -> System:
    """Open the FMUs and connect them over the wheels of a scenario.

    Raises
    ------
    orchestrator.errors.InputError
        For an FMU that is missing, corrupt or another one.
    """
    return System([source.open() for source in sources], connections(scenario, contact))


def fmu_sources(
    scenario: Scenario,
    paths: FmuPaths,
    law: SpeedLaw,
    *,
    contact: ContactSide = "vehicle",
    timeout: float | None = None,
    surfaces: SurfaceFiles | None = None,
) -> tuple[FmuSource, FmuSource]:
    """Name the FMUs and their start values.

    Parameters
    ----------
    scenario : Scenario
        Gives the start values.
    paths : FmuPaths
        FMUs of the scenario's size and of this pair.
    law : SpeedLaw
        Speed of the vehicle.
    contact : {"vehicle", "track"}
        Which of the FMUs has the contacts.
    timeout : float, optional
        Longest answer of an FMU to one call [s], each FMU then being in a process of its own.
    surfaces : SurfaceFiles, optional
        What rail and wheels are uneven by; the files that the scenario names without.

    Returns
    -------
    tuple of FmuSource
        The vehicle and the track.
    """
    return (
        FmuSource(
            path=paths.vehicle,
            name="vehicle",
            start_values=vehicle_values(scenario, law, contact, surfaces=surfaces),
            timeout=timeout,
        ),
        FmuSource(
            path=paths.track,
            name="track",
            start_values=track_values(scenario, law, contact, fixed=paths.fixed, surfaces=surfaces),
            timeout=timeout,
        ),
    )


def connections(scenario: Scenario, contact: ContactSide = "vehicle") -> list[Connection]:
    """Return positions and forces to the track, and rail displacements back.

    With contact on the track side, positions and wheel displacements, and forces back; also what
    the start is settled by, unless wheels that do not know of each other start on a smooth surface.
    """
    exchanged = EXCHANGED[contact]
    if contact == "track" and not _starts_level(scenario):
        exchanged += EXCHANGED_AT_START
    return [
        Connection(
            source=f"{source}.wheel[{k}].{name}",
            target=f"{target}.wheel[{k}].{name}",
        )
        for k in range(1, scenario.vehicle.wheels + 1)
        for source, target, name in exchanged
    ]


def _starts_level(scenario: Scenario) -> bool:
    """Whether nothing can move or load a wheel otherwise at the start than at rest."""
    vehicle = scenario.vehicle
    uneven = vehicle.rail_irregularity or scenario.irregularity or scenario.wheel_defect
    return vehicle.model == "masses" and not uneven


def indicators(wheels: int, contact: ContactSide = "vehicle") -> list[str]:
    """Name the signed gaps, whose changes of sign are switches of contact."""
    return [f"{contact}.wheel[{k}].gap" for k in range(1, wheels + 1)]


def located_events(scenario: Scenario, contact: ContactSide) -> list[str]:
    """Name the indicators on whose switches the master lands.

    A track that has the contacts finds their switches within its steps: an explicit run, which
    repeats no step, leaves them to it.
    """
    if contact == "track" and scenario.master.is_explicit:
        return []
    return indicators(scenario.vehicle.wheels, contact)


def with_steps_for(scenario: Scenario, contact: ContactSide) -> Scenario:
    """Choose the algorithm that a scenario leaves open, and with contact on the track the step."""
    master = scenario.master
    if contact == "vehicle" or master.algorithm is not None:
        return scenario
    step = master.step or EXPLICIT_STEP
    return replace(
        scenario,
        master=replace(master, algorithm="jacobi", step=step, initial_step=None, max_step=None),
    )


def master_settings(scenario: Scenario, contact: ContactSide = "vehicle") -> MasterSettings:
    """Return the settings of the master: a fixed step if the scenario has one, or error control.

    With contact on the track side an explicit run neither repeats steps nor extrapolates: the
    FMUs continue their inputs themselves.
    """
    keys = scenario.master
    algorithm = cast("Literal['newton', 'gauss_seidel', 'jacobi']", keys.algorithm or "newton")
    if keys.step is not None:
        divides = contact == "vehicle" or not keys.is_explicit
        return MasterSettings(
            algorithm=algorithm,
            tolerance=None,
            fixed_step=keys.step,
            min_step=keys.min_step or (SMALLEST_DIVISION * keys.step if divides else None),
            extrapolate=divides,
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
