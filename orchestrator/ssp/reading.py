"""Reading a system structure description (.ssd) of SSP 1.0 or 2.0."""

from pathlib import Path

from .common import for_tools, other_transformations, read_transformation, read_units, type_names
from .description import Component, Connector, Link, SystemDescription
from .documents import Element, read_document
from .files import Folder
from .master_annotation import read_master, refuse_master
from .parameters import read_bindings

for_drawings = ("ssd:ElementGeometry", "ssd:SystemGeometry", "ssd:GraphicalElements")
"""Elements that only say how a system is drawn."""

fmu_type = "application/x-fmu-sharedlibrary"


def read_description(path: Path, folder: Folder) -> SystemDescription:
    """Read a description and the parameter files it names.

    Parameters
    ----------
    path : pathlib.Path
        The .ssd file.
    folder : Folder
        Where the files that it names are.

    Raises
    ------
    SystemFileError
        When it, or a file it names, is not valid or needs something that is not supported.
    """
    root = read_document(path, "ssd:SystemStructureDescription")
    root.allow(
        attributes=["version", "name"],
        children=[
            "ssd:System",
            "ssd:Enumerations",
            "ssd:Units",
            "ssd:DefaultExperiment",
            "ssd:Annotations",
            *for_tools,
        ],
    )
    system = root.child("ssd:System")
    if system is None:
        raise root.error("ssd:System is missing")
    start_time, stop_time = _read_experiment(root.child("ssd:DefaultExperiment"))
    elements = _read_system(system)
    return SystemDescription(
        name=root.need("name"),
        components=tuple(_read_component(item, folder) for item in elements),
        links=_read_links(system.child("ssd:Connections"), _exposed(system)),
        bindings=read_bindings(system, folder.find),
        units=read_units(root.child("ssd:Units")),
        start_time=start_time,
        stop_time=stop_time,
        master=read_master(root.child("ssd:Annotations")),
    )


def _read_experiment(experiment: Element | None) -> tuple[float | None, float | None]:
    if experiment is None:
        return None, None
    experiment.allow(attributes=["startTime", "stopTime"], children=["ssd:Annotations"])
    refuse_master(experiment.child("ssd:Annotations"))
    start, stop = (
        experiment.number(name) if experiment.text(name) is not None else None
        for name in ("startTime", "stopTime")
    )
    return start, stop


def _read_system(system: Element) -> list[Element]:
    """Check the system and return its components."""
    system.allow(
        attributes=["name"],
        children=[
            "ssd:Connectors",
            "ssd:ParameterBindings",
            "ssd:Elements",
            "ssd:Connections",
            "ssd:SignalDictionaries",
            "ssd:Annotations",
            *for_drawings,
            *for_tools,
        ],
    )
    refuse_master(system.child("ssd:Annotations"))
    elements = system.child("ssd:Elements")
    if elements is None:
        raise system.error("ssd:Elements is missing, so there is nothing to simulate")
    for item in elements.children():
        if item.tag == "ssd:System":
            raise item.error("a system within a system is not supported; put its components in")
        if item.tag == "ssd:SignalDictionaryReference":
            raise item.error("signal dictionaries are not supported; connect components directly")
    elements.allow(children=["ssd:Component"])
    return elements.children()


def _exposed(system: Element) -> set[str]:
    """Return the names of the connectors through which the system shows outputs."""
    connectors = _read_connectors(system)
    return {item.name for item in connectors if item.kind == "output"}


def _read_component(component: Element, folder: Folder) -> Component:
    component.allow(
        attributes=["name", "type", "source", "implementation"],
        children=[
            "ssd:Connectors",
            "ssd:ParameterBindings",
            "ssd:Annotations",
            *for_drawings,
            *for_tools,
        ],
    )
    kind = component.text("type") or fmu_type
    if kind != fmu_type:
        raise component.error(f"the type {kind!r} is not supported, only FMUs, {fmu_type!r}, are")
    implementation = component.text("implementation") or "any"
    if implementation not in {"any", "CoSimulation"}:
        raise component.error(
            f"the implementation {implementation!r} is not supported, only 'CoSimulation' is"
        )
    refuse_master(component.child("ssd:Annotations"))
    folder.find(component)
    return Component(
        name=component.need("name"),
        source=component.need("source"),
        connectors=_read_connectors(component),
        bindings=read_bindings(component, folder.find),
    )


def _read_connectors(element: Element) -> tuple[Connector, ...]:
    connectors = element.child("ssd:Connectors")
    if connectors is None:
        return ()
    connectors.allow(children=["ssd:Connector"])
    found: dict[str, Connector] = {}
    for item in connectors.children():
        name = item.need("name")
        if name in found:
            raise item.error(f"there are two connectors {name!r}")
        found[name] = _read_connector(item)
    return tuple(found.values())


def _read_connector(connector: Element) -> Connector:
    types = [f"ssc:{name}" for name in type_names]
    for tag in ("ssc:Binary", "ssc:Clock", "ssd:Clock", "ssc:Dimension"):
        other = connector.child(tag)
        if other is not None:
            raise other.error("connectors of clocks, binary data and arrays are not supported")
    connector.allow(
        attributes=["name", "kind"],
        children=[*types, "ssd:ConnectorGeometry", "ssd:Annotations"],
    )
    kinds = [item for item in connector.children() if item.tag in types]
    if len(kinds) > 1:
        raise connector.error("it has more than one type")
    kind = None
    unit = None
    if kinds:
        kind = type_names[kinds[0].tag.partition(":")[2]]
        unit = kinds[0].text("unit") or None
    return Connector(name=connector.need("name"), kind=connector.need("kind"), type=kind, unit=unit)


def _read_links(connections: Element | None, exposed: set[str]) -> tuple[Link, ...]:
    if connections is None:
        return ()
    connections.allow(children=["ssd:Connection"])
    links = (_read_link(item, exposed) for item in connections.children())
    return tuple(link for link in links if link is not None)


def _read_link(connection: Element, exposed: set[str]) -> Link | None:
    """Read a connection; None for one that only shows an output to the outside."""
    for indices in ("startIndices", "endIndices"):
        if connection.text(indices):
            raise connection.error("connections of array elements are not supported")
    connection.allow(
        attributes=[
            "startElement",
            "startConnector",
            "endElement",
            "endConnector",
            "suppressUnitConversion",
        ],
        children=[
            "ssc:LinearTransformation",
            *other_transformations,
            "ssd:ConnectionGeometry",
            "ssd:Annotations",
        ],
    )
    ends = [
        (connection.text(f"{end}Element"), connection.need(f"{end}Connector"))
        for end in ("start", "end")
    ]
    inner = [(element, name) for element, name in ends if element]
    outer = [name for element, name in ends if not element]
    if outer:
        if len(inner) == 1 and outer[0] in exposed:
            return None
        raise connection.error(
            f"it takes a value from the system's connector {outer[0]!r}, but a system has no "
            "surroundings here; bind a parameter value instead"
        )
    return Link(
        start=inner[0],
        end=inner[1],
        transformation=read_transformation(connection),
        converts_units=not connection.truth("suppressUnitConversion", default=False),
    )
