"""Parameter values (.ssv) and parameter mappings (.ssm), in files of their own or inline."""

from collections.abc import Callable
from pathlib import Path

from ..fmu import StartValue
from .common import for_tools, other_transformations, read_transformation, read_units, type_names
from .description import MappingEntry, ParameterBinding, ParameterValue
from .documents import Element, read_document

Locate = Callable[[Element], Path]
"""Finds the file that the attribute ``source`` of an element names."""


def read_bindings(element: Element, locate: Locate) -> tuple[ParameterBinding, ...]:
    """Read the parameter bindings of a component or of the system.

    Parameters
    ----------
    element : Element
        The component or system.
    locate : callable
        Finds the files that are named.
    """
    bindings = element.child("ssd:ParameterBindings")
    if bindings is None:
        return ()
    bindings.allow(children=["ssd:ParameterBinding"])
    return tuple(_read_binding(binding, locate) for binding in bindings.children())


def _read_binding(binding: Element, locate: Locate) -> ParameterBinding:
    binding.allow(
        attributes=["type", "source", "sourceBase", "prefix"],
        children=["ssd:ParameterValues", "ssd:ParameterMapping", "ssd:Annotations", *for_tools],
    )
    _check_type(binding, "application/x-ssp-parameter-set")
    inline = binding.child("ssd:ParameterValues")
    source = _content(binding, inline, "ssv:ParameterSet", locate)
    source.allow(
        attributes=["version", "name"],
        children=[
            "ssv:Parameters",
            "ssv:Enumerations",
            "ssv:Units",
            "ssv:Annotations",
            *for_tools,
        ],
    )
    parameters = source.child("ssv:Parameters")
    if parameters is None:
        raise source.error("ssv:Parameters is missing")
    parameters.allow(children=["ssv:Parameter"])
    mapping = binding.child("ssd:ParameterMapping")
    return ParameterBinding(
        values=tuple(_read_value(item) for item in parameters.children()),
        prefix=binding.text("prefix") or "",
        mapping=None if mapping is None else _read_mapping(mapping, locate),
        units=read_units(source.child("ssv:Units")),
    )


def _read_value(parameter: Element) -> ParameterValue:
    parameter.allow(
        attributes=["name"],
        children=[*(f"ssv:{name}" for name in (*type_names, "Binary")), "ssv:Annotations"],
    )
    values = [item for item in parameter.children() if item.tag != "ssv:Annotations"]
    if len(values) != 1:
        raise parameter.error(f"it has {len(values)} values but must have one")
    (item,) = values
    kind = type_names.get(item.tag.partition(":")[2])
    if kind not in {"Real", "Integer", "Boolean", "String"}:
        raise item.error(
            "parameters of this type are not supported; give its number as ssv:Integer"
        )
    item.allow(attributes=["value", "unit"] if kind == "Real" else ["value"])
    readers: dict[str, Callable[[str], StartValue]] = {
        "Real": item.number,
        "Integer": item.integer,
        "Boolean": item.truth,
        "String": item.need,
    }
    return ParameterValue(
        name=parameter.need("name"), value=readers[kind]("value"), unit=item.text("unit") or None
    )


def _read_mapping(mapping: Element, locate: Locate) -> tuple[MappingEntry, ...]:
    mapping.allow(attributes=["type", "source", "sourceBase"], children=["ssm:ParameterMapping"])
    _check_type(mapping, "application/x-ssp-parameter-mapping")
    inline = mapping if mapping.children() else None
    source = _content(mapping, inline, "ssm:ParameterMapping", locate)
    source.allow(
        attributes=["version"], children=["ssm:MappingEntry", "ssm:Annotations", *for_tools]
    )
    targets: set[str] = set()
    entries = []
    for item in source.children("ssm:MappingEntry"):
        item.allow(
            attributes=["source", "target", "suppressUnitConversion"],
            children=["ssc:LinearTransformation", *other_transformations, "ssm:Annotations"],
        )
        target = item.need("target")
        if target in targets:
            raise item.error(f"{target!r} is the target of two entries")
        targets.add(target)
        entries.append(
            MappingEntry(
                source=item.need("source"),
                target=target,
                transformation=read_transformation(item),
                converts_units=not item.truth("suppressUnitConversion", default=False),
            )
        )
    return tuple(entries)


def _content(element: Element, inline: Element | None, root: str, locate: Locate) -> Element:
    """Return the root element of what is bound, from its own file or from within."""
    if element.text("source"):
        if inline is not None:
            raise element.error("it has a source and a content of its own; leave one of them out")
        return read_document(locate(element), root)
    if inline is None:
        raise element.error("it has neither a source nor a content of its own")
    inline.allow(attributes=["type", "source", "sourceBase"], children=[root])
    found = inline.child(root)
    if found is None:
        raise inline.error(f"{root} is missing")
    return found


def _check_type(element: Element, wanted: str) -> None:
    kind = element.text("type") or wanted
    if kind != wanted:
        raise element.error(f"the type {kind!r} is not supported, only {wanted!r} is")
    base = element.text("sourceBase") or "SSD"
    if base != "SSD":
        raise element.error(f"sourceBase {base!r} is not supported, only 'SSD' is")
