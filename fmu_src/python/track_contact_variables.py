"""Variables of the FMU of a track with the contacts on its side."""

from __future__ import annotations

from dataclasses import replace

from track_fmu.parameters import TrackParameters

from .model_slave import LINEAR_INPUTS
from .track_parameters import track_parameters
from .track_variables import position_inputs, track_outputs
from .variables import Variable
from .vehicle_variables import (
    WheelOutput,
    excitation_parameters,
    initial_inputs,
    vehicle_parameters,
    wheel_outputs,
)

LOAD_CHANGE = "Force beyond static_wheel_load with which wheel {} presses on the rail at the start"
STARTING = (
    ("load_change", "N", 1e5, LOAD_CHANGE),
    ("velocity", "m/s", 1e-1, "Velocity of wheel {}, downwards positive"),
)
"""Name, unit, nominal value and description of what a vehicle tells about its start."""

INPUT_TIME = replace(
    LINEAR_INPUTS,
    description="Whether an input set before a step is its value at the end of the step, reached "
    "on a straight line from the last one (for hosts that step the vehicle first); false: it is "
    "the value at the start of the step, continued on the parabola through the last three",
)


def declare_track_contact(
    structure: TrackParameters, *, wheels: int, gauges: int
) -> list[Variable]:
    """Variables of a track FMU of given size that finds the contact forces itself.

    Parameters
    ----------
    structure : TrackParameters
        Size of the track; its other values are the start values.
    wheels, gauges : int
        Number of wheels and of bending moment gauges.
    """
    positions = tuple(f"wheel[{i}].position" for i in range(1, wheels + 1))
    loads = tuple(f"wheel[{i}].load_change" for i in range(1, wheels + 1))
    return [
        *track_parameters(structure, gauges),
        *vehicle_parameters("static_wheel_load", "wheel_radius", "hertz_coefficient"),
        *excitation_parameters(wheels),
        *position_inputs(structure, wheels),
        *_displacement_inputs(wheels),
        *initial_inputs(STARTING, wheels),
        *_contact_outputs(wheels, positions, loads),
        *track_outputs(structure, wheels, gauges, known=(*positions, *loads)),
        INPUT_TIME,
    ]


def _displacement_inputs(wheels: int) -> list[Variable]:
    return [
        Variable(
            name=f"wheel[{i + 1}].displacement",
            causality="input",
            group="displacement",
            index=i,
            unit="m",
            nominal=1e-3,
            start=0.0,
            description=f"Displacement of wheel {i + 1}, downwards positive, counted from its "
            "value at the start, where the wheel is in static equilibrium",
        )
        for i in range(wheels)
    ]


def _contact_outputs(
    wheels: int, positions: tuple[str, ...], loads: tuple[str, ...]
) -> list[Variable]:
    own = ("wheel[{}].load_change",)
    kinds: tuple[WheelOutput, ...] = (
        ("contact_force", "N", 0.0, 0.0, 1e5, own,
         "Contact force of wheel {} on the rail, compression positive"),
        ("contact_force_ahead", "N", 0.0, 0.0, 1e5, own,
         ("Contact force of wheel {}, compression positive, continued to the middle of a next step "
          "like the last one: for vehicles that hold their inputs over a step")),
        ("gap", "m", 0.0, None, 1e-4, own,
         "Gap between wheel {} and rail, positive when apart, negative when compressed"),
        ("in_contact", "", False, None, None, own,
         "Whether wheel {} touches the rail"),
        ("static_displacement", "m", 0.0, None, 1e-3,
         (*positions, *loads, "wheel[{}].displacement"),
         ("What the displacement of wheel {} counts from, downwards positive: its displacement in "
          "static equilibrium less the one given there")),
        ("static_velocity", "m/s", 0.0, None, 1e-1, ("wheel[{}].position",),
         "Velocity with which wheel {} follows the surface at the start, downwards positive"),
        ("mean_velocity", "m/s", 0.0, None, 1e-1, ("wheel[{}].position",),
         ("Velocity with which the surface sinks under wheel {} in the mean over a second, half of "
          "it before the start, downwards positive")),
    )  # fmt: skip
    return wheel_outputs(kinds, wheels)
