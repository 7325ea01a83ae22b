"""Variables of the bodies above the wheels: on the vehicle, whichever side has the contacts."""

from __future__ import annotations

from functools import partial

from vehicle_fmu.suspension_parameters import PRIMARY, SECONDARY, BodyParameters

from .variables import Variable, own_parameters

MODEL = (
    "What is above the wheels: masses, nothing but the static wheel load, or suspended, bogie "
    "frames and a car body on springs and dampers"
)
ELEMENT = (
    ("stiffness", "N/m", "Stiffness of the {} suspension, {}"),
    ("damping", "N.s/m", "Damping of the {} suspension in compression, {}"),
    ("rebound_ratio", "1", "Damping in extension over that in compression, {} suspension"),
    ("clearance", "m", "Compression of the {} suspension from static equilibrium at its bump stop"),
    ("stop_stiffness", "N/m", "Stiffness of the bump stop of the {} suspension; 0: none"),
)
ELEMENTS = {"primary": (PRIMARY, "of a wheel"), "secondary": (SECONDARY, "of a bogie")}
BOGIE = (
    ("mass", "kg", "Half the mass of the frame of bogie {}"),
    ("pitch_inertia", "kg.m2", "Half the moment of inertia in pitch of the frame of bogie {}"),
)


def suspension_parameters(bogies: int) -> list[Variable]:
    """Parameters of a vehicle on so many bogies, over one of its rails."""
    bodies = BodyParameters()
    elements = [
        variable
        for name, (element, where) in ELEMENTS.items()
        for variable in own_parameters(
            element,
            f"{name}.",
            tuple((key, unit, text.format(name, where)) for key, unit, text in ELEMENT),
        )
    ]
    frames = [
        Variable(
            name=f"bogie[{j}].{key}",
            causality="parameter",
            unit=unit,
            start=getattr(bodies, f"bogie_{key}")[0],
            description=text.format(j),
        )
        for key, unit, text in BOGIE
        for j in range(1, bogies + 1)
    ]
    return [
        Variable(name="model", causality="parameter", start="masses", description=MODEL),
        *_tread(),
        *elements,
        *frames,
        Variable(
            name="car.mass",
            causality="parameter",
            unit="kg",
            start=bodies.car_mass,
            description="Half the mass of the car body; 0: what the static wheel loads leave",
        ),
        Variable(
            name="car.pitch_inertia",
            causality="parameter",
            unit="kg.m2",
            start=bodies.car_pitch_inertia,
            description="Half the moment of inertia in pitch of the car body",
        ),
    ]


def _tread() -> list[Variable]:
    rows = (
        ("mass", "kg", "Part of a wheel's mass that the rim of a flexible wheelset has; 0: rigid"),
        ("stiffness", "N/m", "Stiffness between rim and hub of a flexible wheelset"),
        ("damping", "N.s/m", "Damping between rim and hub of a flexible wheelset"),
    )
    return [
        Variable(
            name=f"tread.{name}", causality="parameter", unit=unit, start=0.0, description=text
        )
        for name, unit, text in rows
    ]


def loads_are_given(wheels: int, bogies: int) -> bool:
    """Whether every wheel starts with its static load at any height: two a bogie, two bogies."""
    return wheels <= 2 * bogies and bogies <= 2


def body_outputs(wheels: int, bogies: int, *, known: tuple[str, ...] = ()) -> list[Variable]:
    """Motion of the bodies and forces of the suspension; 0 where there are none.

    During the initialisation they depend on the inputs that are `known`.
    """
    rest = "from static equilibrium on a level rail, downwards positive"
    bodies = (
        ("displacement", "m", 1e-3, f"Displacement of {{}} {rest}"),
        ("pitch", "rad", 1e-3, f"Pitch of {{}} {rest.partition(',')[0]}, positive nose down"),
        ("acceleration", "m/s2", 1.0, "Acceleration of {}, downwards positive"),
    )
    outputs = partial(_output, known=known)
    frames = [
        outputs(f"bogie[{j + 1}].{key}", f"bogie_{key}", j, unit, nominal, text.format(what))
        for key, unit, nominal, text in bodies
        for j in range(bogies)
        for what in (f"the frame of bogie {j + 1}",)
    ]
    car = [
        outputs(f"car.{key}", f"car_{key}", 0, unit, nominal, text.format("the car body"))
        for key, unit, nominal, text in bodies
    ]
    forces = [
        outputs(
            f"{name}[{k + 1}].force",
            f"{name}_force",
            k,
            "N",
            1e5,
            f"Force of the {name} suspension of {what} {k + 1}, compression positive",
        )
        for name, what, count in (("primary", "wheel", wheels), ("secondary", "bogie", bogies))
        for k in range(count)
    ]
    return [*frames, *car, *forces]


def _output(  # noqa: PLR0917 - the columns of a table
    name: str,
    group: str,
    index: int,
    unit: str,
    nominal: float,
    description: str,
    *,
    known: tuple[str, ...],
) -> Variable:
    return Variable(
        name=name,
        causality="output",
        group=group,
        index=index,
        unit=unit,
        nominal=nominal,
        description=description,
        initial_dependencies=known,
    )
