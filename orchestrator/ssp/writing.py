"""Writing a system structure description."""

from collections.abc import Mapping, Sequence
from typing import Any

from lxml import etree

from ..fmu import StartValue
from ..units import Linear, Unit, base_units, identity
from .description import (
    Component,
    Connector,
    Link,
    MasterChoices,
    ParameterBinding,
    SettingValue,
    SystemDescription,
)
from .documents import namespaces
from .master_annotation import annotation_type, setting_names


def write_description(description: SystemDescription) -> bytes:
    """Return a description as an SSP 1.0 document; reading it gives the same description.

    Parameters
    ----------
    description : SystemDescription
        What to write; parameter values and mappings become inline ones.

    Returns
    -------
    bytes
        The .ssd file; the same description gives the same bytes.
    """
    root = etree.Element(
        _name("ssd:SystemStructureDescription"),
        nsmap=namespaces,
        version="1.0",
        name=description.name,
    )
    system = _add(root, "ssd:System", name=description.name)
    _add_bindings(system, description.bindings)
    elements = _add(system, "ssd:Elements")
    for component in description.components:
        _add_component(elements, component)
    if description.links:
        connections = _add(system, "ssd:Connections")
        for link in description.links:
            _add_link(connections, link)
    _add_units(root, "ssd:Units", description.units)
    times = {"startTime": description.start_time, "stopTime": description.stop_time}
    given = {name: repr(time) for name, time in times.items() if time is not None}
    if given:
        _add(root, "ssd:DefaultExperiment", **given)
    if description.master != MasterChoices():
        _add_master(root, description.master)
    document: bytes = etree.tostring(
        root, pretty_print=True, xml_declaration=True, encoding="UTF-8"
    )
    return document


def _add_component(elements: Any, component: Component) -> None:  # noqa: ANN401 - lxml: no types
    element = _add(elements, "ssd:Component", name=component.name, source=component.source)
    if component.connectors:
        connectors = _add(element, "ssd:Connectors")
        for connector in component.connectors:
            _add_connector(connectors, connector)
    _add_bindings(element, component.bindings)


def _add_connector(connectors: Any, connector: Connector) -> None:  # noqa: ANN401 - lxml: no types
    element = _add(connectors, "ssd:Connector", name=connector.name, kind=connector.kind)
    if connector.type is not None:
        unit = {} if connector.unit is None else {"unit": connector.unit}
        _add(element, f"ssc:{connector.type}", **unit)


def _add_link(connections: Any, link: Link) -> None:  # noqa: ANN401 - lxml carries no types
    element = _add(
        connections,
        "ssd:Connection",
        startElement=link.start[0],
        startConnector=link.start[1],
        endElement=link.end[0],
        endConnector=link.end[1],
        **_suppressed(link.converts_units),
    )
    _add_transformation(element, link.transformation)


def _add_bindings(parent: Any, bindings: Sequence[ParameterBinding]) -> None:  # noqa: ANN401
    if not bindings:
        return
    group = _add(parent, "ssd:ParameterBindings")
    for binding in bindings:
        prefix = {"prefix": binding.prefix} if binding.prefix else {}
        element = _add(group, "ssd:ParameterBinding", **prefix)
        values = _add(element, "ssd:ParameterValues")
        values = _add(values, "ssv:ParameterSet", version="1.0", name="values")
        parameters = _add(values, "ssv:Parameters")
        for item in binding.values:
            parameter = _add(parameters, "ssv:Parameter", name=item.name)
            unit = {} if item.unit is None else {"unit": item.unit}
            _add(parameter, f"ssv:{_type_of(item.value)}", value=_text(item.value), **unit)
        _add_units(values, "ssv:Units", binding.units)
        if binding.mapping is not None:
            mapping = _add(element, "ssd:ParameterMapping")
            mapping = _add(mapping, "ssm:ParameterMapping", version="1.0")
            for entry in binding.mapping:
                item = _add(
                    mapping,
                    "ssm:MappingEntry",
                    source=entry.source,
                    target=entry.target,
                    **_suppressed(entry.converts_units),
                )
                _add_transformation(item, entry.transformation)


def _add_units(parent: Any, tag: str, units: Mapping[str, Unit]) -> None:  # noqa: ANN401
    if not units:
        return
    group = _add(parent, tag)
    for unit in units.values():
        element = _add(group, "ssc:Unit", name=unit.name)
        exponents = zip(base_units, unit.exponents, strict=True)
        numbers = {symbol: str(exponent) for symbol, exponent in exponents if exponent}
        if (unit.factor, unit.offset) != identity:
            numbers |= {"factor": repr(unit.factor), "offset": repr(unit.offset)}
        _add(element, "ssc:BaseUnit", **numbers)


def _add_transformation(element: Any, change: Linear) -> None:  # noqa: ANN401 - lxml: no types
    if change != identity:
        numbers = {"factor": repr(change.factor), "offset": repr(change.offset)}
        _add(element, "ssc:LinearTransformation", **numbers)


def _add_master(root: Any, master: MasterChoices) -> None:  # noqa: ANN401 - lxml carries no types
    annotations = _add(root, "ssd:Annotations")
    annotation = _add(annotations, "ssc:Annotation", type=annotation_type)
    settings = {
        name: _text(master.settings[name]) for name in setting_names if name in master.settings
    }
    element = _add(annotation, "master:Master", **settings)
    for indicator in master.events:
        _add(element, "master:Event", indicator=indicator)
    for force, motion in master.bonds:
        _add(element, "master:Bond", force=force, motion=motion)


def _add(parent: Any, tag: str, **attributes: str) -> Any:  # noqa: ANN401 - lxml carries no types
    return etree.SubElement(parent, _name(tag), **attributes)


def _name(tag: str) -> str:
    prefix, _, name = tag.partition(":")
    return f"{{{namespaces[prefix]}}}{name}"


def _suppressed(converts_units: bool) -> dict[str, str]:
    return {} if converts_units else {"suppressUnitConversion": "true"}


def _type_of(value: StartValue) -> str:
    return {bool: "Boolean", int: "Integer", float: "Real", str: "String"}[type(value)]


def _text(value: SettingValue) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
