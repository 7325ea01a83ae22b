"""Terminals and build description of an FMU of FMI 3.0."""

from __future__ import annotations

from collections.abc import Sequence
from xml.etree.ElementTree import Element, SubElement

from .model_description import to_bytes
from .models import NativeModel

EXTENT = {"x1": "-100", "y1": "-100", "x2": "100", "y2": "100"}
PORT_SIZE = 20  # of the same units
OPTIONS = "-O2 -ffp-contract=off"


def describe_terminals(model: NativeModel) -> bytes:
    """The file ``terminalsAndIcons.xml``: one terminal for the contact of every wheel."""
    root = Element("fmiTerminalsAndIcons", {"fmiVersion": "3.0"})
    graphics = SubElement(root, "GraphicalRepresentation")
    SubElement(graphics, "CoordinateSystem", EXTENT | {"suggestedScalingFactorTo_mm": "0.1"})
    SubElement(graphics, "Icon", EXTENT)
    terminals = SubElement(root, "Terminals")
    for n, port in enumerate(model.ports):
        terminal = SubElement(
            terminals,
            "Terminal",
            {
                "name": port.name,
                "matchingRule": "plug",
                "terminalKind": "railcosim.wheel_rail_contact",
                "description": port.description,
            },
        )
        for member in port.members:
            SubElement(
                terminal,
                "TerminalMemberVariable",
                {
                    "variableName": f"{port.name}.{member}",
                    "memberName": member,
                    "variableKind": "signal",
                },
            )
        SubElement(
            terminal,
            "TerminalGraphicalRepresentation",
            {"iconBaseName": "wheel", "defaultConnectionColor": "38 70 104"}
            | _place(n, len(model.ports)),
        )
    return to_bytes(root)


def describe_sources(model: NativeModel, files: Sequence[str]) -> bytes:
    """The file ``buildDescription.xml``: how to compile the C files."""
    root = Element("fmiBuildDescription", {"fmiVersion": "3.0"})
    build = SubElement(root, "BuildConfiguration", {"modelIdentifier": model.name})
    sources = SubElement(
        build, "SourceFileSet", {"language": "C11", "compiler": "gcc", "compilerOptions": OPTIONS}
    )
    for name in files:
        SubElement(sources, "SourceFile", {"name": name})
    SubElement(sources, "IncludeDirectory", {"name": "."})
    SubElement(build, "Library", {"name": "m", "external": "true"})
    return to_bytes(root)


def _place(number: int, count: int) -> dict[str, str]:
    """Where a terminal is drawn: below the icon, side by side, the leading wheel at the right."""
    middle = 100.0 - 200.0 * (number + 0.5) / count
    return {
        "x1": f"{middle - PORT_SIZE / 2:g}",
        "y1": f"{-100 - PORT_SIZE}",
        "x2": f"{middle + PORT_SIZE / 2:g}",
        "y2": "-100",
    }
