"""A passage in words: what runs where, how, made by what, and what makes it doubtful."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from ..notes import notes

if TYPE_CHECKING:
    import xarray as xr

    from ..scenario import Scenario
    from ..signals import ContactSide


class Fact(NamedTuple):
    """Something that a table of facts names, and its value."""

    name: str
    value: str


class Warnings(NamedTuple):
    """What a reader must know first.

    Attributes
    ----------
    wrong : list of str
        Why the result is wrong or not whole, a sentence each.
    doubtful : list of str
        What may make it inaccurate, a sentence each.
    """

    wrong: list[str]
    doubtful: list[str]


def sentences(scenario: Scenario) -> list[str]:
    """Tell what is run: the track, the vehicle, its flat and its way."""
    track, vehicle = scenario.track, scenario.vehicle
    bed = (
        "ballast that stiffens under load"
        if track.ballast == "state_dependent"
        else "linear ballast"
    )
    bogies = (
        f" in {vehicle.bogies} bogies, {vehicle.bogie_distance:g} m apart,"
        if vehicle.bogies > 1
        else ""
    )
    wheels = (
        f"{vehicle.wheels} wheels, {vehicle.axle_base:g} m apart{bogies or ','}"
        if vehicle.wheels > 1
        else "One wheel"
    )
    speed = (
        f"at the speeds of {vehicle.speed_table}"
        if vehicle.speed_table
        else f"at {3.6 * vehicle.constant_speed:g} km/h"
    )
    rail = (
        f" with the irregularity of {vehicle.rail_irregularity}"
        if vehicle.rail_irregularity
        else ""
    )
    what = (
        f"{wheels} of {vehicle.wheel_mass:g} kg under {1e-3 * vehicle.static_wheel_load:.2f} kN "
        f"{'each roll' if vehicle.wheels > 1 else 'rolls'} {speed} over a rail{rail} on "
        f"{track.bays - 1} sleepers, {track.sleeper_spacing:g} m apart, on {bed}."
    )
    way = (
        f"The run covers {scenario.run.approach:g} m before and {scenario.run.departure:g} m after "
        "that place."
    )
    above = (
        ["Bogie frames and a car body are above them, on primary and secondary suspension."]
        if vehicle.is_suspended
        else []
    )
    return [what, *above, _flat_sentence(scenario), way]


def _flat_sentence(scenario: Scenario) -> str:
    """Say which flat it is and where it strikes."""
    flat = scenario.flat
    place = f"{scenario.flat_position:g} m along the rail"
    if flat.shape == "none":
        return f"All wheels are round. Wheel {flat.wheel} is followed to {place}."
    if flat.is_measured:
        size = f"the measured flat of {flat.shape}"
    else:
        depth = "" if flat.shape == "chord" else f" and {1e3 * flat.depth:g} mm deep"
        size = f"a {flat.shape} flat, {1e3 * flat.length:g} mm long{depth}"
    rolled = ", over which it rolls geometrically" if flat.rolled else ""
    often = "once per turn, one of them" if flat.periodic else "once,"
    return f"Wheel {flat.wheel} has {size}{rolled}. It strikes {often} at {place}."


def method(passage: xr.Dataset, scenario: Scenario) -> str:
    """Tell how the FMUs were coupled."""
    master, attributes = scenario.master, passage.attrs
    steps = (
        f"fixed steps of {1e6 * master.step:g} µs"
        if master.step is not None
        else f"steps up to {1e6 * master.largest_step:g} µs, controlled to a tolerance of "
        f"{master.tolerance:g}"
    )
    return (
        f"Two {attributes['fmus']} FMUs, track and vehicle, coupled by the {master.algorithm} "
        f"algorithm in {steps}; the contacts are computed in the {attributes['contact']}."
    )


def warnings(passage: xr.Dataset, scenario: Scenario) -> Warnings:
    """Collect what a reader must know before the numbers."""
    contact: ContactSide = "track" if passage.attrs["contact"] == "track" else "vehicle"
    wrong = list(passage.attrs["unreliable"].splitlines())
    if not passage.attrs["complete"]:
        wrong.insert(
            0,
            f"The run ended early, at t = {passage.attrs['simulated_time']:.6g} s: "
            f"{passage.attrs['stop_reason']}.",
        )
    return Warnings(wrong, [*passage.attrs["warnings"].splitlines(), *notes(scenario, contact)])


def provenance(passage: xr.Dataset) -> list[Fact]:
    """Name the programs and the FMUs that made a result."""
    names = {
        "source": "program",
        "versions": "libraries",
        "fmus": "build of the FMUs",
        "contact": "side of the contacts",
        "track_fmu_guid": "GUID of the track's FMU",
        "vehicle_fmu_guid": "GUID of the vehicle's FMU",
        "stop_reason": "end of the run",
    }
    return [
        Fact(words, str(passage.attrs[name]))
        for name, words in names.items()
        if name in passage.attrs
    ]
