"""A passage as a system description with its FMUs (.ssp), for any tool that reads SSP."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING

from fmu_src.archive import holds, write_archive
from orchestrator import MasterSettings
from orchestrator.ssp import (
    Component,
    Connector,
    Link,
    MasterChoices,
    ParameterBinding,
    ParameterValue,
    SystemDescription,
    write_description,
)

from .coupled_system import connections, located_events, master_settings, with_steps_for
from .errors import RunError
from .motion import speed_law, travel_time
from .start_values import track_values, vehicle_values

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

    from fmu_src.building import FmuPaths

    from .scenario import Scenario
    from .signals import ContactSide
    from .start_values import Value


def ensure_package(
    scenario: Scenario,
    fmus: FmuPaths,
    path: Path,
    *,
    contact: ContactSide = "vehicle",
    notify: Callable[[str], None] | None = None,
) -> None:
    """Write the package of a passage where it is missing or stale.

    Parameters
    ----------
    scenario : Scenario
        The passage; it names no files.
    fmus : FmuPaths
        FMUs of its size and of this pair.
    path : Path
        The .ssp file; the same passage and FMUs give the same bytes.
    contact : {"vehicle", "track"}
        Which of the FMUs has the contacts.
    notify : callable, optional
        Told in a few words when it has to be built.

    Raises
    ------
    RunError
        Where it cannot be written.
    """
    files = {
        "SystemStructure.ssd": write_description(describe_passage(scenario, fmus, contact)),
        **{_source(fmu): fmu.read_bytes() for fmu in (fmus.track, fmus.vehicle)},
    }
    if holds(path, files):
        return
    if notify is not None:
        notify(f"building {path.name}")
    try:
        write_archive(path, files)
    except OSError as error:
        raise RunError(
            f"{path} cannot be written: {error.strerror or error}; make that folder writable"
        ) from error


def describe_passage(
    scenario: Scenario, fmus: FmuPaths, contact: ContactSide = "vehicle"
) -> SystemDescription:
    """Return what `run_passage` runs as a system description.

    Parameters
    ----------
    scenario : Scenario
        The passage.
    fmus : FmuPaths
        FMUs of its size and of this pair.
    contact : {"vehicle", "track"}
        Which of the FMUs has the contacts.
    """
    scenario = with_steps_for(scenario, contact)
    law = speed_law(scenario.vehicle)
    links = tuple(
        Link(start=_end(item.source), end=_end(item.target))
        for item in connections(scenario, contact)
    )
    return SystemDescription(
        name="Passage",
        components=(
            _component("vehicle", fmus.vehicle, links, vehicle_values(scenario, law, contact)),
            _component(
                "track",
                fmus.track,
                links,
                track_values(scenario, law, contact, fixed=fmus.fixed),
            ),
        ),
        links=links,
        start_time=0.0,
        stop_time=travel_time(law, scenario.distance),
        master=MasterChoices(
            settings=_chosen(master_settings(scenario, contact)),
            events=tuple(located_events(scenario, contact)),
        ),
    )


def _component(
    name: str, fmu: Path, links: tuple[Link, ...], values: Mapping[str, Value]
) -> Component:
    outputs = [link.start[1] for link in links if link.start[0] == name]
    inputs = [link.end[1] for link in links if link.end[0] == name]
    return Component(
        name=name,
        source=_source(fmu),
        connectors=tuple(
            Connector(name=variable, kind=kind, type="Real")
            for kind, variables in (("input", inputs), ("output", outputs))
            for variable in variables
        ),
        bindings=(
            ParameterBinding(
                values=tuple(ParameterValue(name=key, value=value) for key, value in values.items())
            ),
        ),
    )


def _source(fmu: Path) -> str:
    return f"resources/{fmu.name}"


def _end(path: str) -> tuple[str, str]:
    component, _, variable = path.partition(".")
    return component, variable


def _chosen(settings: MasterSettings) -> dict[str, float | int | bool | str]:
    """Return the settings that are not left to their defaults."""
    values = {item.name: getattr(settings, item.name) for item in fields(settings)}
    defaults = {item.name: item.default for item in fields(settings)}
    return {
        name: value
        for name, value in values.items()
        if value is not None and value != defaults[name]
    }
