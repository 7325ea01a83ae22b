"""Putting the system of a description together: FMUs, their values, connections."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from ..errors import SystemFileError, WiringError, close_matches
from ..fmu import FmuParticipant, StartValue
from ..fmu_source import FmuSource
from ..system import Connection, System
from ..units import identity
from .description import Component, Connector, Link, SystemDescription
from .exchanged_units import convert_between, exchanged_unit
from .files import Folder
from .values import Assignment, assignments, start_value


@dataclass(frozen=True, slots=True, kw_only=True)
class AssembledSystem:
    """A system ready to run.

    Attributes
    ----------
    description : SystemDescription
        What it was made from.
    system : System
        Participants and connections.
    sources : tuple of FmuSource
        What the participants were made from.
    unused : tuple of str
        Names of parameter values that no variable has, which SSP wants to be passed over.
    """

    description: SystemDescription
    system: System
    sources: tuple[FmuSource, ...]
    unused: tuple[str, ...]


def assemble(
    description: SystemDescription, folder: Folder, *, timeout: float | None = None
) -> AssembledSystem:
    """Put a system together.

    Parameters
    ----------
    description : SystemDescription
        The system.
    folder : Folder
        Where its FMUs are.
    timeout : float, optional
        Longest answer of an FMU to one call [s], each FMU then being in a process of its own.

    Raises
    ------
    InputError
        For an FMU that cannot be used, connectors that it does not have, connections or values
        that do not fit.
    """
    unused: list[str] = []
    system_wide = assignments(description.bindings)
    names = {component.name for component in description.components}
    unused += [item.name for item in system_wide if item.name.partition(".")[0] not in names]
    described, sources = {}, []
    for component in description.components:
        path, fmu, values, left = _read(component, description, folder, system_wide)
        described[component.name] = fmu
        sources.append(
            FmuSource(path=path, name=component.name, start_values=values, timeout=timeout)
        )
        unused += left
    for component in description.components:
        for connector in component.connectors:
            _check_connector(described[component.name], connector)
    connections = [_connection(link, description, described) for link in description.links]
    system = System([source.open() for source in sources], connections)
    return AssembledSystem(
        description=description, system=system, sources=tuple(sources), unused=tuple(unused)
    )


def _read(
    component: Component,
    description: SystemDescription,
    folder: Folder,
    system_wide: Sequence[Assignment],
) -> tuple[Path, FmuParticipant, dict[str, StartValue], list[str]]:
    """Return the FMU of a component, what it says, its start values and those it does not know."""
    path = folder.resolve(component.source)
    if path is None:
        raise SystemFileError(f"{component.name}: the source {component.source!r} is out of reach.")
    fmu = FmuParticipant(path, name=component.name)
    wanted = [*assignments(component.bindings), *_own(component.name, system_wide)]
    known = [item for item in wanted if item.name in fmu.variables]
    unused = [f"{component.name}.{item.name}" for item in wanted if item not in known]
    values = {item.name: start_value(item, fmu, description.units) for item in known}
    return path, fmu, values, unused


def _own(name: str, system_wide: Sequence[Assignment]) -> list[Assignment]:
    """Return the values of the system for one component, under the names it knows."""
    return [
        item._replace(name=item.name.removeprefix(f"{name}."))
        for item in system_wide
        if item.name.startswith(f"{name}.")
    ]


def _check_connector(participant: FmuParticipant, connector: Connector) -> None:
    variable = participant.variables.get(connector.name)
    where = f"connector {connector.name!r} of {participant.name}"
    if variable is None:
        raise WiringError(
            f"{where}: the FMU has no such variable; "
            f"{close_matches(connector.name, participant.variables)}."
        )
    if connector.kind not in {variable.causality, variable.variability, "unspecified"}:
        raise WiringError(
            f"{where}: it is of the kind {connector.kind!r}, but the variable of the FMU is of the "
            f"causality {variable.causality!r}."
        )
    if connector.type not in {None, variable.type}:
        raise WiringError(
            f"{where}: it is of the type {connector.type}, but the variable of the FMU is of the "
            f"type {variable.type}."
        )


def _connection(
    link: Link, description: SystemDescription, participants: Mapping[str, FmuParticipant]
) -> Connection:
    """Give a connection its direction and its conversion."""
    components = {component.name: component for component in description.components}
    ends = [(name, _find(components, name, place)) for name, place in (link.start, link.end)]
    (_, first), (_, second) = ends
    if (first.kind, second.kind) == ("input", "output"):
        ends.reverse()
    elif (first.kind, second.kind) != ("output", "input"):
        raise WiringError(
            f"{'.'.join(link.start)} - {'.'.join(link.end)}: a connection joins an output and an "
            f"input, but these are of the kinds {first.kind!r} and {second.kind!r}."
        )
    source, target = (f"{name}.{connector.name}" for name, connector in ends)
    conversion = identity
    if link.converts_units:
        units = [exchanged_unit(participants[name], item, description.units) for name, item in ends]
        try:
            conversion = convert_between(*units)
        except WiringError as error:
            raise WiringError(f"{source} -> {target}: {error}") from error
    return Connection(
        source=source, target=target, conversion=link.transformation.after(conversion)
    )


def _find(components: Mapping[str, Component], name: str, place: str) -> Connector:
    if name not in components:
        raise WiringError(
            f"a connection ends at {name!r}, which is no component; "
            f"{close_matches(name, components)}."
        )
    connectors = {item.name: item for item in components[name].connectors}
    if place not in connectors:
        raise WiringError(
            f"a connection ends at {name}.{place}, but {name} has no connector {place!r}; "
            f"{close_matches(place, connectors)}."
        )
    return connectors[place]
