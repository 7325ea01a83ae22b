"""What is known of a native model before it is packed: its variables and what is fixed in it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, replace
from functools import partial

from fmu_src.python.masses_variables import declare_masses
from fmu_src.python.model_slave import LINEAR_INPUTS
from fmu_src.python.track_contact_variables import declare_track_contact
from fmu_src.python.track_parameters import SLEEPER, TABLE_1
from fmu_src.python.track_variables import declare_track
from fmu_src.python.variables import Value, Variable
from fmu_src.python.vehicle_variables import declare_vehicle
from track_fmu.parameters import TrackParameters

from .model_resources import masses_resource, track_resource, vehicle_resource

TRACK_CONSTANTS = (
    *(name for name, _, _ in (*TABLE_1, *SLEEPER)),
    "mode_pairs",
    "residual_flexibility",
)
"""Parameters of the Python track that are constants of the native one: its modes depend on them."""

FORCE_PORT = ("position", "contact_force", "rail_displacement")
MOTION_PORT = ("position", "displacement", "contact_force")
"""What is connected for every wheel, with the contacts on the vehicle's and on the track's side."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Port:
    """Variables of one wheel that are connected together.

    Attributes
    ----------
    name, description : str
        Name of the terminal and what it is.
    members : tuple of str
        Last parts of the names of the variables, which begin with the name.
    """

    name: str
    description: str
    members: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class NativeModel:
    """A native model of a given size, and of given constants.

    Attributes
    ----------
    kind : str
        Its key in `model_sources.MODELS`.
    name : str
        Model name and identifier.
    description : str
        What it is.
    variables : tuple of Variable
        By value reference, with their start values.
    constants : tuple of str
        Names of those that are fixed.
    structure : mapping of str to int
        Its size.
    ports : tuple of Port
        Variables that are connected together.
    usual : bool
        Whether the constants are those of the paper's track.
    switches : bool
        Whether its steps may end at switches of contact.
    make_resource : callable
        Computes the bytes of the resource that it starts from.
    """

    kind: str
    name: str
    description: str
    variables: tuple[Variable, ...]
    constants: tuple[str, ...] = ()
    structure: Mapping[str, int]
    ports: tuple[Port, ...]
    usual: bool
    switches: bool
    make_resource: Callable[[], bytes]


def native_track(
    *,
    bays: int,
    elements_per_bay: int,
    wheels: int,
    gauges: int,
    fixed: Mapping[str, Value],
    contact: bool = False,
) -> NativeModel:
    """Track of a size.

    Parameters
    ----------
    bays, elements_per_bay, wheels, gauges : int
        Its size.
    fixed : mapping of str to float, int or bool
        Values of `TRACK_CONSTANTS`; those of the paper where one is missing.
    contact : bool
        Whether it finds its contact forces itself.

    Raises
    ------
    ValueError
        For other names, or values that no track can have.
    """
    unknown = sorted(set(fixed) - set(TRACK_CONSTANTS))
    if unknown:
        raise ValueError(
            f"{unknown[0]} is not fixed in a native track; only {', '.join(TRACK_CONSTANTS)} are"
        )
    of_track = {name: fixed[name] for name, _, _ in (*TABLE_1, *SLEEPER) if name in fixed}
    size = TrackParameters(bays=bays, elements_per_bay=elements_per_bay)
    parameters = replace(size, **of_track)  # type: ignore[arg-type]  # checked by the class
    declare = declare_track_contact if contact else _declare_track
    variables = tuple(
        replace(variable, start=fixed.get(variable.name, variable.start))
        if variable.name in TRACK_CONSTANTS
        else variable
        for variable in declare(parameters, wheels=wheels, gauges=gauges)
    )
    start = {variable.name: variable.start for variable in variables}
    return NativeModel(
        kind="track_contact" if contact else "track",
        name="TrackContact" if contact else "Track",
        description="Railway track with state-dependent ballast and its contacts with moving wheels"
        if contact
        else "Railway track with state-dependent ballast under moving wheel-rail forces",
        variables=variables,
        constants=TRACK_CONSTANTS,
        structure={
            "bays": bays,
            "elements_per_bay": elements_per_bay,
            "wheels": wheels,
            "gauges": gauges,
        },
        ports=_ports(wheels, MOTION_PORT if contact else FORCE_PORT),
        usual=list(variables) == declare(size, wheels=wheels, gauges=gauges),
        switches=contact,
        make_resource=partial(
            track_resource,
            parameters,
            wheels=wheels,
            gauges=gauges,
            mode_pairs=int(start["mode_pairs"]),
            residual_flexibility=bool(start["residual_flexibility"]),
            contact=contact,
        ),
    )


def native_vehicle(*, wheels: int, bogies: int = 1) -> NativeModel:
    """Vehicle with so many wheels and bogies; all of its parameters stay parameters."""
    return NativeModel(
        kind="vehicle",
        name="Vehicle",
        description="Moving vehicle in Hertzian contact with the rail, with a wheel flat",
        variables=(*declare_vehicle(wheels, bogies=bogies), LINEAR_INPUTS),
        structure={"wheels": wheels, "bogies": bogies},
        ports=_ports(wheels, FORCE_PORT),
        usual=True,
        switches=True,
        make_resource=partial(vehicle_resource, wheels=wheels, bogies=bogies),
    )


def native_masses(*, wheels: int, bogies: int = 1) -> NativeModel:
    """Vehicle with so many wheels and bogies for a track that finds their contact forces."""
    return NativeModel(
        kind="masses",
        name="Masses",
        description="Moving vehicle under given contact forces, in any number of bogies",
        variables=tuple(declare_masses(wheels, bogies=bogies)),
        structure={"wheels": wheels, "bogies": bogies},
        ports=_ports(wheels, MOTION_PORT),
        usual=True,
        switches=False,
        make_resource=partial(masses_resource, wheels=wheels, bogies=bogies),
    )


def described(model: NativeModel) -> bytes:
    """All that two models of the same sources can differ in, as bytes."""
    size = "".join(f"{name}={value};" for name, value in sorted(model.structure.items()))
    return "\n".join((model.kind, size, *(repr(asdict(v)) for v in model.variables))).encode()


def _declare_track(structure: TrackParameters, *, wheels: int, gauges: int) -> list[Variable]:
    return [*declare_track(structure, wheels=wheels, gauges=gauges), LINEAR_INPUTS]


def _ports(wheels: int, members: tuple[str, ...]) -> tuple[Port, ...]:
    return tuple(
        Port(
            name=f"wheel[{k}]",
            description=f"Contact of wheel {k} with the rail: its place, force and displacement",
            members=members,
        )
        for k in range(1, wheels + 1)
    )
