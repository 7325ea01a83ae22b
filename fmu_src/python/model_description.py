"""Completes the model description that pythonfmu writes.

pythonfmu leaves out units, limits, nominal values, dependencies and initial unknowns, and dates
every build; a description should say what is true and be the same for the same content.
"""

from __future__ import annotations

from collections.abc import Sequence
from xml.etree.ElementTree import Element, SubElement

from .variables import UNITS, Variable

CAPABILITIES = {
    "needsExecutionTool": "false",
    "canHandleVariableCommunicationStepSize": "true",
    "canGetAndSetFMUstate": "true",
    "canSerializeFMUstate": "true",
    "canNotUseMemoryManagementFunctions": "true",
}


def complete(root: Element, variables: Sequence[Variable], *, guid: str) -> Element:
    """Complete a model description in place and return it.

    Parameters
    ----------
    root : Element
        As written by pythonfmu for the same variables in the same order.
    variables : sequence of Variable
        What was declared.
    guid : str
        Identity of the build.
    """
    root.attrib.pop("generationDateAndTime", None)
    root.set("guid", guid)
    simulation = _child(root, "CoSimulation")
    simulation.attrib.update(CAPABILITIES)
    root.insert(list(root).index(simulation) + 1, unit_definitions(variables))
    for element, variable in zip(_child(root, "ModelVariables"), variables, strict=True):
        _complete_variable(element, variable)
    root.remove(_child(root, "ModelStructure"))
    root.append(model_structure(variables))
    return root


def _child(root: Element, tag: str) -> Element:
    child = root.find(tag)
    if child is None:
        raise RuntimeError(f"pythonfmu wrote a model description without {tag}")
    return child


def unit_definitions(variables: Sequence[Variable]) -> Element:
    """Units in use, with their SI exponents."""
    definitions = Element("UnitDefinitions")
    used = {variable.unit for variable in variables if variable.unit}
    for name, exponents in UNITS.items():
        if name in used:
            unit = SubElement(definitions, "Unit", {"name": name})
            if exponents or name == "1":
                SubElement(unit, "BaseUnit", {base: str(e) for base, e in exponents.items()})
    return definitions


def _complete_variable(element: Element, variable: Variable) -> None:
    """Add unit, limits and nominal value to a Real; no output has a start value."""
    kind = element[0]
    if variable.causality == "output":
        kind.attrib.pop("start", None)
    kind.attrib.update(limits(variable))


def limits(variable: Variable) -> dict[str, str]:
    """Unit, limits and nominal value, where a variable has them."""
    attributes = {
        "unit": variable.unit or None,
        "min": variable.minimum,
        "max": variable.maximum,
        "nominal": variable.nominal,
    }
    return {
        name: value if isinstance(value, str) else repr(value)
        for name, value in attributes.items()
        if value is not None
    }


def model_structure(variables: Sequence[Variable]) -> Element:
    """Outputs depend on inputs through steps only, so at a communication point on nothing."""
    number = {variable.name: str(i) for i, variable in enumerate(variables, start=1)}
    structure = Element("ModelStructure")
    outputs, initial = Element("Outputs"), Element("InitialUnknowns")
    for variable in variables:
        if variable.causality == "output":
            index = number[variable.name]
            SubElement(outputs, "Unknown", {"index": index, "dependencies": ""})
            known = sorted((number[name] for name in variable.initial_dependencies), key=int)
            SubElement(initial, "Unknown", {"index": index, "dependencies": " ".join(known)})
    structure.append(outputs)
    structure.append(initial)
    return structure
