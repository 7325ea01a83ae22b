"""Wheel masses as an FMU: contact forces in, positions and displacements of the wheels out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from vehicle_fmu.masses import Masses, MassesParameters
from vehicle_fmu.standing import Standing
from vehicle_fmu.suspended_masses import SuspendedMasses

from .excitation import speed_law, wheel_offsets
from .masses_variables import declare_masses
from .model_slave import ModelSlave
from .suspended import make_suspension, read_bodies

FloatArray = NDArray[np.float64]


class MassesSlave(ModelSlave):
    """Moving masses or a suspended vehicle, for a track with the contacts on its side."""

    description = "Moving vehicle under given contact forces, in any number of bogies"
    wheels: ClassVar[int] = 2
    bogies: ClassVar[int] = 1

    def declare(self) -> Sequence[Any]:
        """All variables; see `masses_variables`."""
        return declare_masses(self.wheels, bogies=self.bogies)

    def make_model(self, parameters: Mapping[str, Any]) -> Masses:
        """Masses of the given parameters; a table of speeds is read from its file."""
        offsets = wheel_offsets(parameters, self.wheels)
        names = ("wheel_mass", "static_wheel_load", "initial_position")
        masses = MassesParameters(offsets=offsets, **{name: parameters[name] for name in names})
        suspension = make_suspension(parameters, offsets=offsets, bogies=self.bogies)
        speed = speed_law(parameters)
        if suspension is None:
            return Masses(masses, speed=speed)
        return SuspendedMasses(
            masses, speed=speed, suspension=suspension, substep=parameters["substep"]
        )

    def start_model(self, model: Masses, time: float, inputs: Mapping[str, FloatArray]) -> None:
        """Static equilibrium on wheels that stand where the track says."""
        model.initialise(time, inputs["contact_force"], _standing(inputs))

    def step_model(
        self,
        model: Masses,
        time: float,
        step_size: float,
        inputs: Mapping[str, FloatArray],
        *,
        linear: bool,
    ) -> None:
        """One step; what matters at the start only must be numbers later on as well."""
        _standing(inputs)
        model.step(time, step_size, inputs["contact_force"], linear=linear)

    def read_model(self, model: Masses, group: str) -> Sequence[float]:
        """Outputs by the names of the model."""
        if not hasattr(Masses, group):
            suspended = model if isinstance(model, SuspendedMasses) else None
            return read_bodies(suspended, group, wheels=self.wheels, bogies=self.bogies)
        values: list[float] = getattr(model, group).tolist()
        return values


def _standing(inputs: Mapping[str, FloatArray]) -> Standing:
    return Standing(
        displacement=inputs["static_displacement"],
        velocity=inputs["static_velocity"],
        mean_velocity=inputs["mean_velocity"],
    )
