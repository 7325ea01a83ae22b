"""The CSV files that a scenario names, read before the run so that a bad one costs no run."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING, TypeVar, cast

import numpy as np

from fmu_src.python.supports import make_factors
from fmu_src.python.tables import read_table
from fmu_src.python.track_laws import make_laws
from vehicle_fmu.irregularity import RailIrregularity
from vehicle_fmu.parameters import FlatParameters
from vehicle_fmu.wheel_profile import WheelProfileTable, check_flat

from .errors import InputError
from .support_values import support_properties
from .track_data import track_parameters

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from vehicle_fmu.parameters import FlatShape

    from .scenario import Scenario

T = TypeVar("T")

STEEPEST = 1.0
"""Largest slope of a measured rail; drops in millimetres are far beyond."""


def read_as(
    kind: Callable[..., T], path: str, columns: Sequence[str], *, optional: Sequence[str] = ()
) -> T:
    """Read a CSV file into a table.

    Parameters
    ----------
    kind : callable
        Table whose parameters are the columns.
    path : str
        The file.
    columns : sequence of str
        Names of its columns, from the left.
    optional : sequence of str
        Columns that may follow.

    Raises
    ------
    InputError
        For a file that cannot be read or does not hold such a table.
    """
    try:
        values = read_table(path, columns, optional=optional)
    except ValueError as error:
        raise InputError(str(error)) from error
    try:
        return kind(**values)
    except ValueError as error:
        raise InputError(f"table {path}: {error}") from error


def read_flat(scenario: Scenario) -> tuple[FlatParameters, WheelProfileTable | None]:
    """Read the flat of a scenario, with the table of a measured one, and see that it fits.

    Raises
    ------
    InputError
        For a file that is no such table, or a flat that does not fit on its wheel.
    """
    flat = scenario.flat
    table = (
        read_as(WheelProfileTable, flat.shape, ("distance", "drop")) if flat.is_measured else None
    )
    parameters = FlatParameters(
        shape=cast("FlatShape", "table" if flat.is_measured else flat.shape),
        length=flat.length,
        depth=flat.depth,
        wheel=flat.wheel,
        position=scenario.flat_position,
        periodic=flat.periodic,
        rolled=flat.rolled,
    )
    try:
        check_flat(
            parameters, table, radius=scenario.vehicle.wheel_radius, wheels=scenario.vehicle.wheels
        )
    except ValueError as error:
        raise InputError(str(error)) from error
    return parameters, table


def read_irregularity(scenario: Scenario) -> RailIrregularity | None:
    """Read the irregularity of the railhead, None for a smooth one.

    Raises
    ------
    InputError
        For a file that is no such table.
    """
    path = scenario.vehicle.rail_irregularity
    return read_rail(path) if path else None


def read_rail(path: str, scale: float = 1.0) -> RailIrregularity:
    """Read a measured rail.

    Parameters
    ----------
    path : str
        CSV file with the columns position and drop.
    scale : float
        What its drops are multiplied by to be metres, for the check alone.

    Raises
    ------
    InputError
        For a file that is no such table, or a rail that no wheel can follow.
    """
    table = read_as(RailIrregularity, path, ("position", "drop"))
    with np.errstate(over="ignore"):
        slopes = np.abs(scale * np.diff(table.drop) / np.diff(table.position))
    worst = int(slopes.argmax())
    if slopes[worst] > STEEPEST:
        raise InputError(
            f"table {path}: the rail changes by {slopes[worst]:.3g} m per metre behind "
            f"{table.position[worst]:g} m, but at most {STEEPEST:g} can be: give its drops in "
            "metres, or as a table of the kind csv with a scale"
        )
    return table


def check_laws(scenario: Scenario) -> None:
    """Read the tables of ballast, pads and supports.

    Raises
    ------
    InputError
        For a file that is no such table.
    """
    track = scenario.track
    values = {item.name: getattr(track, item.name) for item in fields(track)}
    supports = support_properties(scenario)
    try:
        make_laws(track_parameters(track), values, make_factors(supports))
    except ValueError as error:
        raise InputError(str(error)) from error


def check_profiles(scenario: Scenario) -> None:
    """Read all tables of the track and the vehicle, and see that the flat fits on the wheel.

    Raises
    ------
    InputError
        For a file that is no such table, or a flat that does not fit.
    """
    check_laws(scenario)
    read_irregularity(scenario)
    flat, table = read_flat(scenario)
    if flat.shape == "none":
        return
    begins = -0.5 * flat.length if table is None else float(table.distance[0])
    if scenario.run.approach < -begins:
        raise InputError(
            f"run.approach is {scenario.run.approach:g} m but the flat begins {-begins:g} m before "
            "its centre: start earlier, on the round wheel"
        )
