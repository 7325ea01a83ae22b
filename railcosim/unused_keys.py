"""Keys of a scenario that its other keys leave without effect."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

from .presets import PRESETS
from .rail_sections import Joint
from .scenario_file import SECTIONS
from .suspension_section import Suspension
from .wheel_sections import MeasuredWheel, Polygon

if TYPE_CHECKING:
    from collections.abc import Iterator

    from .rail_sections import RailSection
    from .scenario import Scenario

POLYNOMIAL = ("ballast_alpha", "ballast_beta", "ballast_delta")
BENDING = (
    "sleeper_half_length",
    "sleeper_rail_seat",
    "sleeper_bending_stiffness",
    "sleeper_shear_stiffness",
    "sleeper_mass_per_length",
    "sleeper_rotary_inertia_per_length",
    "sleeper_elements",
)
TREAD = ("tread_mass", "tread_stiffness", "tread_damping")


@dataclass(frozen=True, slots=True)
class _Unused:
    """Keys of a section that have no effect, and why."""

    section: str
    keys: tuple[str, ...]
    reason: str


def unused_keys(scenario: Scenario) -> list[str]:
    """Say in a sentence each which keys that differ from their default have no effect.

    Parameters
    ----------
    scenario : Scenario
        Those that its preset gives count as defaults.
    """
    found = []
    for rule in (*_of_track(scenario), *_of_vehicle(scenario), *_of_surfaces(scenario)):
        given = [f"{rule.section}.{key}" for key in rule.keys if _is_given(scenario, rule, key)]
        if given:
            verb = "has" if len(given) == 1 else "have"
            found.append(f"{', '.join(given)} {verb} no effect: {rule.reason}")
    return found + _elsewhere(scenario)


def _is_given(scenario: Scenario, rule: _Unused, key: str) -> bool:
    preset = PRESETS.get(scenario.vehicle.preset or "")
    usual = preset.keys().get(rule.section, {}) if preset else {}
    default = getattr(SECTIONS[rule.section](), key)
    return bool(getattr(getattr(scenario, rule.section), key) != usual.get(key, default))


def _of_track(scenario: Scenario) -> Iterator[_Unused]:
    track, variation = scenario.track, scenario.variation
    if track.ballast != "state_dependent":
        yield _Unused("track", POLYNOMIAL, "they belong to track.ballast = state_dependent")
    if track.ballast != "hyperbolic":
        yield _Unused("track", ("ballast_slope",), "it belongs to track.ballast = hyperbolic")
    if track.ballast_mass == 0.0:
        yield _Unused("track", ("ballast_mass_grows",), "track.ballast_mass is 0")
    if track.pad == "linear":
        yield _Unused("track", ("clip_preload",), "track.pad is linear")
    if track.sleeper == "rigid":
        yield _Unused("track", BENDING, "track.sleeper is rigid")
    else:
        yield _Unused("track", ("sleeper_mass",), "track.sleeper_mass_per_length is in its place")
    deviations = (
        variation.pad_stiffness_deviation,
        variation.ballast_stiffness_deviation,
        variation.sleeper_mass_deviation,
    )
    if not any(deviations):
        keys = ("seed", "correlation_length")
        yield _Unused("variation", keys, "every deviation of [variation] is 0")
    if variation.transition_factor == 1.0:
        keys = ("transition_begin", "transition_length")
        yield _Unused("variation", keys, "variation.transition_factor is 1")
    if not variation.hanging_sleepers:
        yield _Unused("variation", ("hanging_gap",), "variation.hanging_sleepers names none")


def _of_vehicle(scenario: Scenario) -> Iterator[_Unused]:
    vehicle, suspension = scenario.vehicle, scenario.suspension
    if vehicle.bogies == 1:
        yield _Unused("vehicle", ("bogie_distance",), "vehicle.bogies is 1")
    if vehicle.wheels == vehicle.bogies:
        yield _Unused("vehicle", ("axle_base",), "a bogie has one wheel")
    if vehicle.rail_radius is None and not scenario.surface.contact_filter:
        reason = "they count with vehicle.rail_radius or surface.contact_filter"
        yield _Unused("vehicle", ("youngs_modulus", "poissons_ratio"), reason)
    if suspension.tread_mass == 0.0:
        yield _Unused("suspension", TREAD, "suspension.tread_mass is 0")
    if not vehicle.is_suspended:
        keys = tuple(item.name for item in fields(Suspension) if item.name not in TREAD)
        yield _Unused("suspension", keys, "vehicle.model is masses")
        return
    for part in ("primary", "secondary"):
        if getattr(suspension, f"{part}_stop_stiffness") == 0.0:
            reason = f"suspension.{part}_stop_stiffness is 0"
            yield _Unused("suspension", (f"{part}_clearance",), reason)
        if getattr(suspension, f"{part}_damping") == 0.0:
            reason = f"suspension.{part}_damping is 0"
            yield _Unused("suspension", (f"{part}_rebound_ratio",), reason)


def _of_surfaces(scenario: Scenario) -> Iterator[_Unused]:
    flat, treads = scenario.flat, scenario.wheel_defect
    if flat.shape == "none":
        yield _Unused("flat", ("length", "depth", "periodic", "rolled"), "flat.shape is none")
    elif flat.is_measured:
        yield _Unused("flat", ("length", "depth"), f"{flat.shape} brings both")
    if not scenario.irregularity:
        yield _Unused("surface", ("ramp",), "there is no [[irregularity]]")
        if not any(isinstance(item, (Polygon, MeasuredWheel)) for item in treads):
            reason = "there is no [[irregularity]], polygon or measured tread that it could weaken"
            yield _Unused("surface", ("contact_filter",), reason)
    if scenario.keep.is_all:
        yield _Unused("keep", ("stretch",), "keep.signals names nothing")


def _elsewhere(scenario: Scenario) -> list[str]:
    """Name supports and irregularities that no wheel comes to."""
    found = []
    if scenario.track.endless:
        for key, last in scenario.variation.last_listed().items():
            if last > scenario.supports:
                found.append(
                    f"variation.{key} names support {last}, but the run reaches "
                    f"{scenario.supports} only"
                )
    begin, end = scenario.start_position, scenario.start_position + scenario.distance
    for number, item in enumerate(scenario.irregularity, start=1):
        low, high = _reach(item)
        if low >= end or high <= begin:
            found.append(
                f"irregularity[{number}] has no effect: it lies from {low:g} to {high:g} m, but "
                f"wheels roll over irregularities from {begin:g} to {end:g} m"
            )
    return found


def _reach(item: RailSection) -> tuple[float, float]:
    """Return where an irregularity begins and ends [m], as far as its keys say."""
    if isinstance(item, Joint):
        return item.position - 0.5 * item.length, item.position + 0.5 * item.length
    infinite = float("inf")
    return (
        -infinite if item.begin is None else item.begin,
        infinite if item.end is None else item.end,
    )
