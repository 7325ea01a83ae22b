"""Wheel masses as an FMU: contact forces in, positions and displacements of the wheels out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from vehicle_fmu.masses import Masses, MassesParameters

from .excitation import speed_law
from .masses_variables import declare_masses
from .model_slave import ModelSlave

FloatArray = NDArray[np.float64]


class MassesSlave(ModelSlave):
    """Moving wheel masses in any number of bogies, for a track with the contacts on its side."""

    description = "Moving wheel masses under given contact forces, in any number of bogies"
    wheels: ClassVar[int] = 2

    def declare(self) -> Sequence[Any]:
        """All variables; see `masses_variables`."""
        return declare_masses(self.wheels)

    def make_model(self, parameters: Mapping[str, Any]) -> Masses:
        """Masses of the given parameters; a table of speeds is read from its file."""
        behind = (parameters[f"wheel[{i}].offset"] for i in range(2, self.wheels + 1))
        names = ("wheel_mass", "static_wheel_load", "initial_position")
        return Masses(
            MassesParameters(offsets=(0.0, *behind), **{name: parameters[name] for name in names}),
            speed=speed_law(parameters),
        )

    def start_model(self, model: Masses, time: float, inputs: Mapping[str, FloatArray]) -> None:
        """At rest in static equilibrium."""
        model.initialise(time, inputs["contact_force"])

    def step_model(
        self,
        model: Masses,
        time: float,
        step_size: float,
        inputs: Mapping[str, FloatArray],
        *,
        linear: bool,
    ) -> None:
        """One step."""
        model.step(time, step_size, inputs["contact_force"], linear=linear)

    def read_model(self, model: Masses, group: str) -> Sequence[float]:
        """Outputs by the names of the model."""
        values: list[float] = getattr(model, group).tolist()
        return values
