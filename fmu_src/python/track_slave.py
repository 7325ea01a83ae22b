"""The track as an FMU: contact forces and positions of the wheels in, rail displacements out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields
from functools import lru_cache
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from track_fmu.assembly import assemble
from track_fmu.ballast import PolynomialBallast
from track_fmu.parameters import TrackParameters
from track_fmu.reduction import ReducedTrack, reduce_track
from track_fmu.track_model import TrackModel, TrackOptions

from .basis_cache import cached_basis
from .model_slave import LINEAR_INPUTS, ModelSlave
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
        """Track of the given parameters; its modal basis comes from the cache if it is there."""
        names = {field.name for field in fields(TrackParameters)}
        track = TrackParameters(
            bays=self.bays,
            elements_per_bay=self.elements_per_bay,
            **{name: value for name, value in parameters.items() if name in names},
        )
        options = TrackOptions(
            wheels=self.wheels,
            supports_per_wheel=parameters["supports_per_wheel"],
            initial_speed=parameters["initial_speed"],
            gauges=tuple(parameters[f"gauge[{k}].position"] for k in range(1, self.gauges + 1)),
        )
        reduced = _reduced_track(
            track, parameters["mode_pairs"], parameters["residual_flexibility"]
        )
        return TrackModel(reduced, options, ballast=_ballast_law(track, parameters))

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


@lru_cache(maxsize=4)
def _reduced_track(
    parameters: TrackParameters, mode_pairs: int, residual_flexibility: bool
) -> ReducedTrack:
    """Reduced track; instances with the same parameters share it, none changes it."""
    matrices = assemble(parameters)
    basis = cached_basis(parameters, matrices, mode_pairs=mode_pairs)
    return reduce_track(parameters, matrices, basis, residual_flexibility=residual_flexibility)


def _ballast_law(track: TrackParameters, parameters: Mapping[str, Any]) -> PolynomialBallast | None:
    kind = parameters["ballast"]
    if kind == "linear":
        return None
    if kind == "state_dependent":
        return PolynomialBallast(
            alpha=parameters["ballast_alpha"],
            beta=parameters["ballast_beta"],
            delta=parameters["ballast_delta"],
            tau=track.ballast_damping / track.ballast_stiffness,
        )
    raise ValueError(f"track: ballast is {kind!r}; it must be 'state_dependent' or 'linear'")
