"""The track as an FMU: contact forces and positions of the wheels in, rail displacements out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from track_fmu.parameters import TrackParameters
from track_fmu.track_model import TrackModel

from .model_slave import LINEAR_INPUTS, ModelSlave
from .track_making import make_track
from .track_variables import declare_track

FloatArray = NDArray[np.float64]


class TrackSlave(ModelSlave):
    """Complex modal track with state-dependent ballast under moving wheels."""

    description = "Railway track with state-dependent ballast under moving wheel-rail forces"
    bays: ClassVar[int] = 50
    elements_per_bay: ClassVar[int] = 8
    wheels: ClassVar[int] = 2
    gauges: ClassVar[int] = 3

    def declare(self) -> Sequence[Any]:
        """All variables; see `track_variables`."""
        structure = TrackParameters(bays=self.bays, elements_per_bay=self.elements_per_bay)
        variables = declare_track(structure, wheels=self.wheels, gauges=self.gauges)
        return [*variables, LINEAR_INPUTS]

    def make_model(self, parameters: Mapping[str, Any]) -> TrackModel:
        """Track of the given parameters."""
        return make_track(
            parameters,
            bays=self.bays,
            elements_per_bay=self.elements_per_bay,
            wheels=self.wheels,
            gauges=self.gauges,
        )

    def start_model(self, model: TrackModel, time: float, inputs: Mapping[str, FloatArray]) -> None:
        """Nonlinear static equilibrium under the wheels."""
        del time
        model.start(inputs["position"], inputs["contact_force"])

    def step_model(
        self,
        model: TrackModel,
        time: float,
        step_size: float,
        inputs: Mapping[str, FloatArray],
        *,
        linear: bool,
    ) -> None:
        """One step; the track does not depend on time itself."""
        del time
        model.step(step_size, inputs["position"], inputs["contact_force"], linear=linear)

    def read_model(self, model: TrackModel, group: str) -> Sequence[float]:
        """Outputs by the names of the model's own observation."""
        if group == "rail_displacement":
            displacement: list[float] = model.rail_displacement.tolist()
            return displacement  # without the rest of an observation
        values: list[float] = getattr(model.observe(), group).tolist()
        return values
