"""Variables of the vehicle FMU."""

from __future__ import annotations

from vehicle_fmu.parameters import FlatParameters, VehicleParameters

from .suspension_variables import body_outputs, loads_are_given, suspension_parameters
from .variables import Variable, own_parameters

WheelOutput = tuple[str, str, float, float | None, float | None, tuple[str, ...], str]
"""Name, unit, value of its type, minimum, nominal value, initial dependencies, description."""

# name, unit, description; the start values are those of the models' own parameters
VEHICLE = (
    ("wheel_mass", "kg", "Mass moving with each wheel, half the unsprung mass of a wheelset"),
    ("static_wheel_load", "N", "Total static wheel-rail force, the only weight in the model"),
    ("wheel_radius", "m", "Rolling radius of the wheels"),
    ("hertz_coefficient", "N/m1.5", "Contact force over compression to the power 1.5"),
    ("initial_position", "m", "Track position of wheel 1, the leading one, at the start"),
    ("substep", "s", "Longest internal integration step"),
)
FLAT_POSITION = (
    "Track position at which the centre of the flat meets the rail, and the angle zero of every "
    "out-of-roundness"
)
FLAT = (
    ("length", "m", "Length of the flat along the tread"),
    ("depth", "m", "Largest drop of the tread; a chord's follows from its length"),
    ("wheel", "", "The wheel that has the flat, counted from 1"),
    ("position", "m", FLAT_POSITION),
    ("periodic", "", "Whether the flat meets the rail at every turn, or once only"),
    ("rolled", "", "Whether the wheel rolls over the profile, or follows it as it is"),
)
SHAPE = (
    "Shape of the flat: haversine, parabola, cusp, chord, none, or the path of a CSV file with "
    "distance [m] and drop [m]"
)
SPEED = 40.0 / 3.6  # m/s, of the demonstration example


def declare_vehicle(wheels: int, *, bogies: int = 1) -> list[Variable]:
    """Variables of a vehicle FMU with the given number of wheels and bogies."""
    return [
        *speed_parameters(),
        *vehicle_parameters(*(name for name, _, _ in VEHICLE)),
        *offset_parameters(wheels),
        *suspension_parameters(bogies),
        *excitation_parameters(wheels),
        *_inputs(wheels),
        *_outputs(wheels, bogies),
        *body_outputs(wheels, bogies, known=rails(wheels)),
    ]


def rails(wheels: int) -> tuple[str, ...]:
    """Inputs that say how high every wheel stands."""
    return tuple(f"wheel[{i + 1}].rail_displacement" for i in range(wheels))


def offset_parameters(wheels: int) -> list[Variable]:
    """How far each wheel but the first runs behind it."""
    return [
        Variable(
            name=f"wheel[{i + 1}].offset",
            causality="parameter",
            unit="m",
            start=i * VehicleParameters().offsets[1],
            description=f"Distance of wheel {i + 1} behind wheel 1, the leading one",
        )
        for i in range(1, wheels)
    ]


def speed_parameters() -> list[Variable]:
    """How a vehicle moves along the track."""
    return [
        Variable(
            name="speed",
            causality="parameter",
            unit="m/s",
            start=SPEED,
            minimum=0.0,
            description="Constant speed along the track",
        ),
        Variable(
            name="speed_table",
            causality="parameter",
            start="",
            description="Path of a CSV file with time [s] and speed [m/s], instead of the "
            "constant speed; empty: none",
        ),
    ]


def excitation_parameters(wheels: int) -> list[Variable]:
    """Irregularity of the railhead, flat of a wheel and out-of-roundness of every wheel."""
    flat = FlatParameters(shape="haversine")
    return [
        Variable(
            name="rail_irregularity",
            causality="parameter",
            start="",
            description="Path of a CSV file with track position [m] and drop of the railhead "
            "[m], downwards positive; empty: a smooth rail",
        ),
        Variable(name="flat.shape", causality="parameter", start=flat.shape, description=SHAPE),
        *own_parameters(flat, "flat.", FLAT),
        *(
            Variable(
                name=f"wheel[{i + 1}].out_of_roundness",
                causality="parameter",
                start="",
                description="Path of a CSV file with angle [rad] around the tread of wheel "
                f"{i + 1}, from 0 to below 2 pi, and its drop [m], positive where metal is "
                "missing; empty: a round wheel",
            )
            for i in range(wheels)
        ),
    ]


def vehicle_parameters(*names: str) -> list[Variable]:
    """Some of the parameters `VEHICLE`, in its order."""
    rows = tuple(row for row in VEHICLE if row[0] in names)
    return own_parameters(VehicleParameters(), "", rows)


def _inputs(wheels: int) -> list[Variable]:
    return [
        Variable(
            name=f"wheel[{i + 1}].rail_displacement",
            causality="input",
            group="rail_displacement",
            index=i,
            unit="m",
            nominal=1e-3,
            start=0.0,
            description=f"Displacement of the rail under wheel {i + 1}, downwards positive",
        )
        for i in range(wheels)
    ]


def _outputs(wheels: int, bogies: int) -> list[Variable]:
    fixed = loads_are_given(wheels, bogies)
    on_rail = ("wheel[{}].rail_displacement",) if fixed else rails(wheels)
    loaded = () if fixed else rails(wheels)
    kinds: tuple[WheelOutput, ...] = (
        ("position", "m", 0.0, None, 1.0, (),
         "Track position of wheel {}"),
        ("contact_force", "N", 0.0, 0.0, 1e5, loaded,
         "Contact force of wheel {} on the rail, compression positive"),
        ("displacement", "m", 0.0, None, 1e-3, on_rail,
         "Displacement of wheel {}, downwards positive"),
        ("velocity", "m/s", 0.0, None, 1e-1, (),
         "Velocity of wheel {}, downwards positive"),
        ("gap", "m", 0.0, None, 1e-4, loaded,
         "Gap between wheel {} and rail, positive when apart, negative when compressed"),
        ("in_contact", "", False, None, None, loaded,
         "Whether wheel {} touches the rail"),
    )  # fmt: skip
    return wheel_outputs(kinds, wheels)


def initial_inputs(kinds: tuple[tuple[str, str, float, str], ...], wheels: int) -> list[Variable]:
    """Inputs of every wheel that matter during the initialisation only, kind by kind."""
    return [
        Variable(
            name=f"wheel[{i + 1}].{name}",
            causality="input",
            group=name,
            index=i,
            unit=unit,
            nominal=nominal,
            start=0.0,
            description=f"{description.format(i + 1)}; used during the initialisation only",
        )
        for name, unit, nominal, description in kinds
        for i in range(wheels)
    ]


def wheel_outputs(kinds: tuple[WheelOutput, ...], wheels: int) -> list[Variable]:
    """Outputs that every wheel has, kind by kind; {} stands for the number of the wheel."""
    return [
        Variable(
            name=f"wheel[{i + 1}].{name}",
            causality="output",
            group=name,
            index=i,
            unit=unit,
            start=kind,
            minimum=minimum,
            nominal=nominal,
            description=description.format(i + 1),
            initial_dependencies=tuple(known.format(i + 1) for known in dependencies),
        )
        for name, unit, kind, minimum, nominal, dependencies, description in kinds
        for i in range(wheels)
    ]
