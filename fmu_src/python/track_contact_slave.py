"""The track with its contacts as an FMU: wheel positions and displacements in, forces out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray
from pythonfmu.enums import Fmi2Status

from track_fmu.contact_start import check_start_inputs
from track_fmu.contact_track import ContactTrack
from track_fmu.parameters import TrackParameters
from vehicle_fmu.hertz_contact import HertzContact
from vehicle_fmu.surfaces import Surfaces

from .excitation import irregularity, make_flat, out_of_roundness
from .model_slave import ModelSlave
from .track_contact_variables import declare_track_contact
from .track_making import make_track

FloatArray = NDArray[np.float64]
OF_THE_CONTACT = {
    "contact_force",
    "contact_force_ahead",
    "gap",
    "in_contact",
    "mean_velocity",
    "rail_displacement",
    "static_displacement",
    "static_velocity",
}


class TrackContactSlave(ModelSlave):
    """Track with state-dependent ballast, and the Hertzian contacts of the wheels on it."""

    description = "Railway track with state-dependent ballast and its contacts with moving wheels"
    bays: ClassVar[int] = 50
    elements_per_bay: ClassVar[int] = 8
    wheels: ClassVar[int] = 2
    gauges: ClassVar[int] = 3

    def declare(self) -> Sequence[Any]:
        """All variables; see `track_contact_variables`."""
        structure = TrackParameters(bays=self.bays, elements_per_bay=self.elements_per_bay)
        return declare_track_contact(structure, wheels=self.wheels, gauges=self.gauges)

    def make_model(self, parameters: Mapping[str, Any]) -> ContactTrack:
        """Track and contacts of the given parameters; tables are read from their files."""
        track = make_track(
            parameters,
            bays=self.bays,
            elements_per_bay=self.elements_per_bay,
            wheels=self.wheels,
            gauges=self.gauges,
        )
        flat, table = make_flat(parameters)
        return ContactTrack(
            track,
            law=HertzContact(parameters["hertz_coefficient"]),
            surface=Surfaces(
                flat,
                flat_table=table,
                irregularity=irregularity(parameters["rail_irregularity"]),
                out_of_roundness=out_of_roundness(parameters, wheels=self.wheels),
                wheels=self.wheels,
                radius=parameters["wheel_radius"],
            ),
            static_load=parameters["static_wheel_load"],
        )

    def start_model(
        self, model: ContactTrack, time: float, inputs: Mapping[str, FloatArray]
    ) -> None:
        """Nonlinear static equilibrium under the static wheel loads."""
        del time
        model.start(
            inputs["position"],
            inputs["displacement"],
            load_change=inputs["load_change"],
            velocity=inputs["velocity"],
        )

    def step_model(
        self,
        model: ContactTrack,
        time: float,
        step_size: float,
        inputs: Mapping[str, FloatArray],
        *,
        linear: bool,
    ) -> None:
        """One step; the track does not depend on time itself.

        What matters at the start only must be numbers later on as well.
        """
        del time
        check_start_inputs(inputs["load_change"], inputs["velocity"])
        positions = inputs["position"]
        if not linear:
            for doubt in model.doubts(step_size, positions):
                self.log(doubt, Fmi2Status.warning)
        model.step(step_size, positions, inputs["displacement"], linear=linear)

    def read_model(self, model: ContactTrack, group: str) -> Sequence[float]:
        """Outputs of the contacts by the names of the model, others by those of an observation."""
        source = model if group in OF_THE_CONTACT else model.observe()
        values: list[float] = getattr(source, group).tolist()
        return values
