"""Surfaces, offsets and speed from the parameters of an FMU, tables from files."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, cast

from vehicle_fmu.irregularity import RailIrregularity
from vehicle_fmu.out_of_roundness import OutOfRoundness
from vehicle_fmu.parameters import FlatParameters, FlatShape
from vehicle_fmu.speed import ConstantSpeed, SpeedTable
from vehicle_fmu.wheel_profile import WheelProfileTable

from .tables import read_table
from .vehicle_variables import FLAT


def make_flat(parameters: Mapping[str, Any]) -> tuple[FlatParameters, WheelProfileTable | None]:
    """Flat of the given parameters, with the table of a measured one."""
    shape, table = _flat_shape(parameters["flat.shape"])
    values = {name: parameters[f"flat.{name}"] for name, _, _ in FLAT}
    return FlatParameters(shape=shape, **values), table


def wheel_offsets(parameters: Mapping[str, Any], wheels: int) -> tuple[float, ...]:
    """How far each wheel runs behind the first [m]."""
    return (0.0, *(parameters[f"wheel[{i}].offset"] for i in range(2, wheels + 1)))


def speed_law(parameters: Mapping[str, Any]) -> ConstantSpeed | SpeedTable:
    """Constant speed, or that of a table."""
    path = parameters["speed_table"]
    if not path:
        return ConstantSpeed(speed=parameters["speed"])
    columns = read_table(path, ("time", "speed"))
    return SpeedTable(time=columns["time"], speed=columns["speed"])


def irregularity(path: str) -> RailIrregularity | None:
    """Irregularity of the railhead from a table; none without a path."""
    if not path:
        return None
    columns = read_table(path, ("position", "drop"))
    return RailIrregularity(position=columns["position"], drop=columns["drop"])


def out_of_roundness(parameters: Mapping[str, Any], *, wheels: int) -> list[OutOfRoundness | None]:
    """Out-of-roundness of every wheel from its table; none of a wheel without a path."""
    paths = [parameters[f"wheel[{i + 1}].out_of_roundness"] for i in range(wheels)]
    return [_tread(path) if path else None for path in paths]


def _tread(path: str) -> OutOfRoundness:
    columns = read_table(path, ("angle", "drop"))
    return OutOfRoundness(angle=columns["angle"], drop=columns["drop"])


def _flat_shape(shape: str) -> tuple[FlatShape, WheelProfileTable | None]:
    """Shape of the flat; a file name stands for a measured profile."""
    if not shape.lower().endswith(".csv"):
        return cast("FlatShape", shape), None  # the parameters check it
    columns = read_table(shape, ("distance", "drop"))
    return "table", WheelProfileTable(distance=columns["distance"], drop=columns["drop"])
