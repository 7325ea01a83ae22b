"""The suspension of an FMU from its parameters, and its outputs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from vehicle_fmu.bodies import Suspended, observe_bodies
from vehicle_fmu.suspension import Suspension
from vehicle_fmu.suspension_parameters import BodyParameters, SuspensionElement, Tread

from .suspension_variables import BOGIE, ELEMENT, ELEMENTS

MODELS = ("masses", "suspended")


def make_suspension(
    parameters: Mapping[str, Any], *, offsets: tuple[float, ...], bogies: int
) -> Suspension | None:
    """Suspension of the given parameters; None for rigid masses under their loads.

    Raises
    ------
    ValueError
        For a model there is none of, or bodies that no vehicle can have.
    """
    model = parameters["model"]
    if model not in MODELS:
        raise ValueError(f"model is {model!r}; it must be one of {', '.join(MODELS)}")
    tread = None
    if parameters["tread.mass"] != 0.0:
        tread = Tread(
            **{key: parameters[f"tread.{key}"] for key in ("mass", "stiffness", "damping")}
        )
    if model == "masses" and tread is None:
        return None
    return Suspension(
        offsets=offsets,
        wheel_mass=parameters["wheel_mass"],
        load=parameters["static_wheel_load"],
        tread=tread,
        bogies=bogies,
        bodies=_bodies(parameters, bogies) if model == "suspended" else None,
    )


def read_bodies(
    model: Suspended | None, group: str, *, wheels: int, bogies: int
) -> Sequence[float]:
    """Outputs of a group; zeros for rigid masses."""
    if model is None:
        counts = {"primary": wheels, "secondary": bogies, "bogie": bogies, "car": 1}
        return np.zeros(counts[group.partition("_")[0]]).tolist()
    values: list[float] = observe_bodies(model)[group].tolist()
    return values


def _bodies(parameters: Mapping[str, Any], bogies: int) -> BodyParameters:
    elements = {
        name: SuspensionElement(**{key: parameters[f"{name}.{key}"] for key, _, _ in ELEMENT})
        for name in ELEMENTS
    }
    frames = {
        f"bogie_{key}": tuple(parameters[f"bogie[{j}].{key}"] for j in range(1, bogies + 1))
        for key, _, _ in BOGIE
    }
    return BodyParameters(
        primary=elements["primary"],
        secondary=elements["secondary"],
        bogie_mass=frames["bogie_mass"],
        bogie_pitch_inertia=frames["bogie_pitch_inertia"],
        car_mass=parameters["car.mass"],
        car_pitch_inertia=parameters["car.pitch_inertia"],
    )
