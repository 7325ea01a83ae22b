"""The page on the FMUs and their variables, made from the model descriptions themselves."""

from __future__ import annotations

import html
import re
from collections.abc import Iterable, Iterator
from itertools import groupby
from xml.etree.ElementTree import Element, fromstring

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files

from fmu_src.native.model_description import describe_fmi2, describe_fmi3
from fmu_src.native.models import NativeModel, native_masses, native_track, native_vehicle
from fmu_src.python.packaging import fmu_contents
from fmu_src.structure import Structure

INTRODUCTION = """# FMUs and their variables

Made from the model descriptions. The tables show the default structure: {bays} bays, {wheels}
wheels, {gauges} gauges; `[1..n]` stands for one variable of each number. Parameters are fixed once
the FMU is initialised; those marked * are constants of the native FMUs, whose modes were computed
with them ([native FMUs](native_fmus.md#other-tracks) says how to get others). Which pair to take,
and which step: [pairs](pairs.md).
"""
CAPABILITIES = {
    "canGetAndSetFMUstate": "gives and takes back its state",
    "canSerializeFMUstate": "serialises its state",
    "canInterpolateInputs": "takes input derivatives",
    "providesDirectionalDerivative": "directional derivatives",
    "providesAdjointDerivatives": "adjoint derivatives",
    "mightReturnEarlyFromDoStep": "may return early, at a switch of contact",
}
"""What an FMU can say of itself; FMI 3.0 spells the first four a little differently."""

CAUSALITIES = {"input": "Inputs", "output": "Outputs", "parameter": "Parameters"}
NUMBER = re.compile(r"\[\d+\]")
COUNTED = re.compile(r"\b([Ww]heel|[Ss]leeper|[Gg]auge|[Pp]ad|[Bb]ed) \d+")


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the page."""
    size = Structure()
    track = size.of("track") | {"fixed": {}}
    models = {
        "track": native_track(**track),
        "vehicle": native_vehicle(wheels=size.wheels),
        "track_contact": native_track(**track, contact=True),
        "masses": native_masses(wheels=size.wheels),
    }
    parts = [INTRODUCTION.format(bays=size.bays, wheels=size.wheels, gauges=size.gauges)]
    for kind, model in models.items():
        parts += _section(_parsed(fmu_contents(kind, size.of(kind))["modelDescription.xml"]), model)
    files.append(File.generated(config, "fmu_reference.md", content="\n".join(parts)))
    return files


def _parsed(xml: str | bytes) -> Element:
    return fromstring(xml)  # noqa: S314 - made by this project a moment ago


def _section(python: Element, model: NativeModel) -> Iterator[str]:
    """One FMU: what it can, then its variables."""
    described = {
        "Python, FMI 2.0": python,
        "native, FMI 2.0": _parsed(describe_fmi2(model, token="", sources=())),
        "native, FMI 3.0": _parsed(describe_fmi3(model, token="")),
    }
    yield f"\n## {model.name}\n\n{model.description}.\n"
    yield f"| | {' | '.join(described)} |"
    yield "|---|" + "---|" * len(described)
    claims = [_claims(description) for description in described.values()]
    for name, meaning in CAPABILITIES.items():
        answers = ["yes" if name.lower() in claimed else "no" for claimed in claims]
        yield f"| {meaning} | {' | '.join(answers)} |"
    variables = list(python.iter("ScalarVariable"))
    for causality, heading in CAUSALITIES.items():
        chosen = [v for v in variables if v.get("causality") == causality]
        if chosen:
            yield f"\n### {heading} of {model.name}\n"
            yield from _table(chosen, model.constants)


def _claims(description: Element) -> set[str]:
    """Names of what is claimed, in small letters, in the spelling of FMI 2.0."""
    attributes = next(description.iter("CoSimulation")).attrib
    claims = {name.lower() for name, value in attributes.items() if value == "true"}
    if "providesdirectionalderivatives" in claims:
        claims.add("providesdirectionalderivative")
    return claims


def _table(variables: Iterable[Element], constants: tuple[str, ...]) -> Iterator[str]:
    yield "| variable | unit | start | limits | meaning |\n|---|---|---|---|---|"
    for _, group in groupby(variables, key=lambda variable: NUMBER.sub("[k]", _name(variable))):
        members = list(group)
        several = len(members) > 1
        name = (
            f"[1..{len(members)}]".join(NUMBER.split(_name(members[0])))
            if several
            else _name(members[0])
        )
        meaning = members[0].get("description", "")
        cells = (
            f"`{name}`{' *' if name in constants else ''}",
            members[0][0].get("unit", ""),
            _starts(members),
            _limits(members[0][0]),
            html.escape(COUNTED.sub(r"\1 k", meaning) if several else meaning),
        )
        yield f"| {' | '.join(cells)} |"


def _name(variable: Element) -> str:
    return variable.attrib["name"]


def _starts(variables: list[Element]) -> str:
    starts = dict.fromkeys(v[0].attrib["start"] for v in variables if "start" in v[0].attrib)
    return ", ".join(f"`{start}`" if start else "empty" for start in starts)


def _limits(value: Element) -> str:
    low, high = value.get("min"), value.get("max")
    if high is None:
        return "" if low is None else f"at least {low}"
    return f"at most {high}" if low is None else f"{low} to {high}"
