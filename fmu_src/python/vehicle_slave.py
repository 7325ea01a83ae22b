"""The vehicle as an FMU: rail displacements in, contact forces and positions of the wheels out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar, cast

import numpy as np
from numpy.typing import NDArray

from vehicle_fmu.irregularity import RailIrregularity
from vehicle_fmu.parameters import FlatParameters, FlatShape, VehicleParameters
from vehicle_fmu.speed import ConstantSpeed, SpeedTable
from vehicle_fmu.vehicle_model import VehicleModel
from vehicle_fmu.wheel_profile import WheelProfileTable

from .model_slave import LINEAR_INPUTS, ModelSlave
from .tables import read_table
from .vehicle_variables import FLAT, VEHICLE, declare_vehicle

FloatArray = NDArray[np.float64]


class VehicleSlave(ModelSlave):
    """Moving masses in Hertzian contact with the rail, with a wheel flat."""

    description = "Moving wheel masses in Hertzian contact with the rail, with a wheel flat"
    wheels: ClassVar[int] = 2

    def declare(self) -> Sequence[Any]:
        """All variables; see `vehicle_variables`."""
        return [*declare_vehicle(self.wheels), LINEAR_INPUTS]

    def make_model(self, parameters: Mapping[str, Any]) -> VehicleModel:
        """Vehicle of the given parameters; tables are read from their files."""
        vehicle = VehicleParameters(
            wheels=self.wheels, **{name: parameters[name] for name, _, _ in VEHICLE}
        )
        shape, table = _flat_shape(parameters["flat.shape"])
        flat = FlatParameters(
            shape=shape, **{name: parameters[f"flat.{name}"] for name, _, _ in FLAT}
        )
        return VehicleModel(
            vehicle,
            flat=flat,
            flat_table=table,
            speed=_speed(parameters),
            irregularity=_irregularity(parameters["rail_irregularity"]),
        )

    def start_model(
        self, model: VehicleModel, time: float, inputs: Mapping[str, FloatArray]
    ) -> None:
        """Static equilibrium on the rail."""
        model.initialise(time, inputs["rail_displacement"])

    def step_model(
        self,
        model: VehicleModel,
        time: float,
        step_size: float,
        inputs: Mapping[str, FloatArray],
        *,
        linear: bool,
    ) -> None:
        """One step."""
        model.step(time, step_size, inputs["rail_displacement"], linear=linear)

    def read_model(self, model: VehicleModel, group: str) -> Sequence[float]:
        """Outputs by the names of the model."""
        values: list[float] = getattr(model, group).tolist()
        return values


def _flat_shape(shape: str) -> tuple[FlatShape, WheelProfileTable | None]:
    """Shape of the flat; a file name stands for a measured profile."""
    if not shape.lower().endswith(".csv"):
        return cast("FlatShape", shape), None  # the parameters check it
    columns = read_table(shape, ("distance", "drop"))
    return "table", WheelProfileTable(distance=columns["distance"], drop=columns["drop"])


def _speed(parameters: Mapping[str, Any]) -> ConstantSpeed | SpeedTable:
    path = parameters["speed_table"]
    if not path:
        return ConstantSpeed(speed=parameters["speed"])
    columns = read_table(path, ("time", "speed"))
    return SpeedTable(time=columns["time"], speed=columns["speed"])


def _irregularity(path: str) -> RailIrregularity | None:
    if not path:
        return None
    columns = read_table(path, ("position", "drop"))
    return RailIrregularity(position=columns["position"], drop=columns["drop"])
