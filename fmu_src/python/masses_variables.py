"""Variables of the FMU of wheel masses whose contacts are elsewhere."""

from __future__ import annotations

from dataclasses import replace

from vehicle_fmu.parameters import VehicleParameters

from .model_slave import LINEAR_INPUTS
from .suspension_variables import body_outputs, loads_are_given, suspension_parameters
from .variables import Variable
from .vehicle_variables import (
    initial_inputs,
    offset_parameters,
    speed_parameters,
    vehicle_parameters,
)

HEIGHT = "Displacement of wheel {} in static equilibrium, from any level, downwards positive"
FOLLOWING = "Velocity with which {} follow the surface at the start, downwards positive"
STANDING = (
    ("static_displacement", "m", 1e-3, HEIGHT),
    ("static_velocity", "m/s", 1e-1, FOLLOWING.replace("{} follow", "wheel {} follows")),
    ("mean_velocity", "m/s", 1e-1, FOLLOWING.replace("{}", "bodies above wheel {}")),
)
"""Name, unit, nominal value and description of what a track tells about the start."""

INPUT_TIME = replace(
    LINEAR_INPUTS,
    description="Whether an input set before a step is its value at the end of the step, reached "
    "on a straight line from the last one (for hosts that step the track first); false: it is the "
    "value at the start of the step, continued on the last straight line until the next one",
)


def declare_masses(wheels: int, *, bogies: int = 1) -> list[Variable]:
    """Variables of an FMU of the given number of wheels and bogies."""
    heights = tuple(f"wheel[{i + 1}].static_displacement" for i in range(wheels))
    return [
        *speed_parameters(),
        *vehicle_parameters("wheel_mass", "static_wheel_load", "initial_position", "substep"),
        *offset_parameters(wheels),
        *suspension_parameters(bogies),
        *_inputs(wheels),
        *_outputs(wheels, loaded=() if loads_are_given(wheels, bogies) else heights),
        *body_outputs(wheels, bogies, known=heights),
        INPUT_TIME,
    ]


def _inputs(wheels: int) -> list[Variable]:
    forces = [
        Variable(
            name=f"wheel[{i + 1}].contact_force",
            causality="input",
            group="contact_force",
            index=i,
            unit="N",
            nominal=1e5,
            minimum=0.0,
            start=VehicleParameters().static_wheel_load,
            description=f"Contact force of the rail on wheel {i + 1}, compression positive",
        )
        for i in range(wheels)
    ]
    return [*forces, *initial_inputs(STANDING, wheels)]


def _outputs(wheels: int, *, loaded: tuple[str, ...]) -> list[Variable]:
    kinds = (
        ("position", "m", 1.0, (), "Track position of wheel {}"),
        ("displacement", "m", 1e-3, (),
         "Displacement of wheel {} from its static equilibrium, downwards positive"),
        ("velocity", "m/s", 1e-1, ("wheel[{}].static_velocity",),
         "Velocity of wheel {}, downwards positive"),
        ("load_change", "N", 1e5, loaded,
         "Force beyond its static load with which wheel {} presses on the rail at the start"),
    )  # fmt: skip
    return [
        Variable(
            name=f"wheel[{i + 1}].{name}",
            causality="output",
            group=name,
            index=i,
            unit=unit,
            nominal=nominal,
            description=description.format(i + 1),
            initial_dependencies=tuple(known.format(i + 1) for known in dependencies),
        )
        for name, unit, nominal, dependencies, description in kinds
        for i in range(wheels)
    ]
