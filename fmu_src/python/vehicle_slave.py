"""The vehicle as an FMU: rail displacements in, contact forces and positions of the wheels out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from vehicle_fmu.parameters import VehicleParameters
from vehicle_fmu.suspended_vehicle import SuspendedVehicle
from vehicle_fmu.vehicle_model import VehicleModel

from .excitation import irregularity, make_flat, out_of_roundness, speed_law, wheel_offsets
from .model_slave import LINEAR_INPUTS, ModelSlave
from .suspended import make_suspension, read_bodies
from .vehicle_variables import VEHICLE, declare_vehicle

FloatArray = NDArray[np.float64]


class VehicleSlave(ModelSlave):
    """Moving masses or a suspended vehicle in Hertzian contact with the rail, with a wheel flat."""

    description = "Moving vehicle in Hertzian contact with the rail, with a wheel flat"
    wheels: ClassVar[int] = 2
    bogies: ClassVar[int] = 1

    def declare(self) -> Sequence[Any]:
        """All variables; see `vehicle_variables`."""
        return [*declare_vehicle(self.wheels, bogies=self.bogies), LINEAR_INPUTS]

    def make_model(self, parameters: Mapping[str, Any]) -> VehicleModel:
        """Vehicle of the given parameters; tables are read from their files."""
        offsets = wheel_offsets(parameters, self.wheels)
        vehicle = VehicleParameters(
            offsets=offsets, **{name: parameters[name] for name, _, _ in VEHICLE}
        )
        flat, table = make_flat(parameters)
        rolling: dict[str, Any] = {
            "flat": flat,
            "flat_table": table,
            "speed": speed_law(parameters),
            "irregularity": irregularity(parameters["rail_irregularity"]),
            "out_of_roundness": out_of_roundness(parameters, wheels=self.wheels),
        }
        suspension = make_suspension(parameters, offsets=offsets, bogies=self.bogies)
        if suspension is None:
            return VehicleModel(vehicle, **rolling)
        return SuspendedVehicle(vehicle, suspension=suspension, **rolling)

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
        if not hasattr(VehicleModel, group):
            suspended = model if isinstance(model, SuspendedVehicle) else None
            return read_bodies(suspended, group, wheels=self.wheels, bogies=self.bogies)
        values: list[float] = getattr(model, group).tolist()
        return values
