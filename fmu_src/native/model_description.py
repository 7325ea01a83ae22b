"""Model descriptions of the native FMUs, for FMI 2.0 and FMI 3.0, from the same declarations."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import groupby
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from fmu_src.python.model_description import limits, model_structure, unit_definitions
from fmu_src.python.variables import Value, Variable

from .models import NativeModel

ATTRIBUTES = {
    "author": "The railcosim authors",
    "license": "BSD-3-Clause",
    "generationTool": "railcosim",
    "variableNamingConvention": "structured",
}
CATEGORIES = {
    "logStatusDiscard": "Steps that cannot be made, and values that are not known",
    "logStatusError": "Calls and values that are refused",
    "logStatusWarning": "What is doubtful about steps that are made",
}
INDEX = re.compile(r"\[\d+\]")
COUNTED = re.compile(r"\b(wheel|sleeper|gauge|bogie) \d+")
"""Where a name, and where a description, says which of several variables it is."""

FMI2_TYPES = {bool: "Boolean", int: "Integer", float: "Real", str: "String"}
FMI3_TYPES = {bool: "Boolean", int: "Int32", float: "Float64", str: "String"}


def describe_fmi2(model: NativeModel, *, token: str, sources: Sequence[str]) -> bytes:
    """Model description of FMI 2.0.

    Parameters
    ----------
    model : NativeModel
        The model.
    token : str
        Identity of the build.
    sources : sequence of str
        C files to compile.
    """
    root = Element(
        "fmiModelDescription",
        {"fmiVersion": "2.0", "modelName": model.name, "guid": token}
        | {"description": model.description}
        | ATTRIBUTES
        | {"numberOfEventIndicators": "0"},
    )
    simulation = SubElement(
        root,
        "CoSimulation",
        {
            "modelIdentifier": model.name,
            "canHandleVariableCommunicationStepSize": "true",
            "canInterpolateInputs": "true",
            "maxOutputDerivativeOrder": "1",
            "canNotUseMemoryManagementFunctions": "true",
            "canGetAndSetFMUstate": "true",
            "canSerializeFMUstate": "true",
            "providesDirectionalDerivative": "true",
        },
    )
    files = SubElement(simulation, "SourceFiles")
    for name in sources:
        SubElement(files, "File", {"name": name})
    _add_common(root, model)
    variables = SubElement(root, "ModelVariables")
    for reference, variable in enumerate(model.variables):
        scalar = SubElement(variables, "ScalarVariable", _common(model, variable, reference))
        value = SubElement(scalar, FMI2_TYPES[type(variable.start)], limits(variable))
        if variable.causality != "output":
            value.set("start", _text(variable.start))
    root.append(model_structure(model.variables))
    return to_bytes(root)


def describe_fmi3(model: NativeModel, *, token: str) -> bytes:
    """Model description of FMI 3.0; see `describe_fmi2`.

    What users connect is scalar and has the same names in both versions. Besides, arrays show all
    wheels, sleepers or gauges at once, to be read only.
    """
    root = Element(
        "fmiModelDescription",
        {"fmiVersion": "3.0", "modelName": model.name, "instantiationToken": token}
        | {"description": model.description}
        | ATTRIBUTES,
    )
    SubElement(
        root,
        "CoSimulation",
        {
            "modelIdentifier": model.name,
            "canGetAndSetFMUState": "true",
            "canSerializeFMUState": "true",
            "providesDirectionalDerivatives": "true",
            "providesAdjointDerivatives": "true",
            "canHandleVariableCommunicationStepSize": "true",
            "maxOutputDerivativeOrder": "1",
            "mightReturnEarlyFromDoStep": _text(model.switches),
            "providesIntermediateUpdate": "true",
        },
    )
    _add_common(root, model)
    variables = SubElement(root, "ModelVariables")
    for reference, variable in enumerate(model.variables):
        attributes = _common(model, variable, reference) | limits(variable)
        kind = FMI3_TYPES[type(variable.start)]
        if variable.causality == "output":
            SubElement(variables, kind, attributes)
        elif kind == "String":
            text = SubElement(variables, kind, attributes)
            SubElement(text, "Start", {"value": _text(variable.start)})
        else:
            SubElement(variables, kind, attributes | {"start": _text(variable.start)})
    SubElement(
        variables,
        "Float64",
        {
            "name": "time",
            "valueReference": str(len(model.variables)),
            "causality": "independent",
            "variability": "continuous",
            "unit": "s",
            "description": "Time",
        },
    )
    _add_arrays(variables, model.variables)
    _add_structure(root, model.variables)
    return to_bytes(root)


def _add_arrays(element: Element, variables: Sequence[Variable]) -> None:
    """Arrays of inputs and outputs that differ by an index; time and all variables come before."""
    exchanged = [
        (place, variable)
        for place, variable in enumerate(variables)
        if variable.causality != "parameter" and isinstance(variable.start, float)
    ]
    for name, group in groupby(exchanged, key=lambda item: INDEX.sub("", item[1].name)):
        members = list(group)
        place, first = members[0]
        if name == first.name:
            continue
        array = SubElement(
            element,
            "Float64",
            {
                "name": name,
                "valueReference": str(len(variables) + 1 + place),
                "description": COUNTED.sub(r"every \1", first.description),
                "causality": "local",
                "variability": "continuous",
                "initial": "calculated",
                "unit": first.unit,
            },
        )
        SubElement(array, "Dimension", {"start": str(len(members))})


def to_bytes(root: Element) -> bytes:
    """An indented XML file."""
    indent(root)
    text: str = tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'.encode()


def _add_common(root: Element, model: NativeModel) -> None:
    time = Variable(name="time", causality="output", unit="s", description="")
    root.append(unit_definitions([*model.variables, time]))
    categories = SubElement(root, "LogCategories")
    for name, description in CATEGORIES.items():
        SubElement(categories, "Category", {"name": name, "description": description})
    SubElement(root, "DefaultExperiment", {"startTime": "0", "stopTime": "0.1"})


def _common(model: NativeModel, variable: Variable, reference: int) -> dict[str, str]:
    """Attributes that a variable has in both versions."""
    causality: str = variable.causality
    if variable.name in model.constants:
        causality, variability, initial = "local", "constant", "exact"
    elif causality == "parameter":
        variability, initial = "fixed", "exact"
    else:
        variability = "continuous" if isinstance(variable.start, float) else "discrete"
        initial = "calculated" if causality == "output" else ""
    attributes = {
        "name": variable.name,
        "valueReference": str(reference),
        "description": variable.description,
        "causality": causality,
        "variability": variability,
        "initial": initial,
    }
    return {name: value for name, value in attributes.items() if value}


def _add_structure(root: Element, variables: Sequence[Variable]) -> None:
    """The structure in the words of FMI 3.0: value references instead of places."""
    structure = SubElement(root, "ModelStructure")
    place = {variable.name: n for n, variable in enumerate(variables)}
    outputs = [variable for variable in variables if variable.causality == "output"]
    for variable in outputs:
        reference = str(place[variable.name])
        SubElement(structure, "Output", {"valueReference": reference, "dependencies": ""})
    for variable in outputs:
        known = sorted(place[name] for name in variable.initial_dependencies)
        SubElement(
            structure,
            "InitialUnknown",
            {
                "valueReference": str(place[variable.name]),
                "dependencies": " ".join(str(n) for n in known),
            },
        )


def _text(value: Value) -> str:
    """A value as XML writes it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    return value if isinstance(value, str) else repr(value)
