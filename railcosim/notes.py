"""What a user should know about a scenario that is allowed but may surprise."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .master_section import DEFAULT_MAX_STEP, Master
from .sections import Flat
from .wheel_sections import WheelFlat

if TYPE_CHECKING:
    from .scenario import Scenario
    from .signals import ContactSide

KINKED = ("parabola", "cusp", "chord")
"""Shapes of flats and other dents with a kink, at their tip or at their edges."""

PAIRS_PER_BAY_AT_KINKS = 8
"""Mode pairs per bay that resolve a kink; as verified, see docs/verification.md."""


def notes(scenario: Scenario, contact: ContactSide = "vehicle") -> list[str]:
    """Say in a sentence each what has no effect and what costs accuracy."""
    found = []
    flat, master = scenario.flat, scenario.master
    depth_is_given = flat.depth != Flat().depth
    if depth_is_given and flat.shape == "chord":
        depth = flat.length**2 / (8.0 * scenario.vehicle.wheel_radius)
        found.append(
            f"flat.depth has no effect: a chord of {1e3 * flat.length:g} mm is "
            f"{1e3 * depth:.3g} mm deep"
        )
    if depth_is_given and flat.is_measured:
        found.append(f"flat.depth has no effect: {flat.shape} brings the depth")
    pairs = PAIRS_PER_BAY_AT_KINKS * scenario.track.bays
    kinked = _kinked(scenario)
    if kinked and scenario.track.retained_pairs < min(pairs, scenario.track.degrees_of_freedom):
        found.append(
            f"{kinked[0]} has a kink, which excites the rail above the frequencies of its "
            f"{scenario.track.retained_pairs} mode pairs: just behind it the contact force may be "
            f"off by 9 to 17 % of the static load, its peak by 5 %; take track.mode_pairs={pairs}"
        )
    step = master.step or master.largest_step
    if step > DEFAULT_MAX_STEP:
        found.append(
            f"steps up to {step:g} s do not resolve the vibration of the rail: expect errors above "
            f"1 % unless they are at most {DEFAULT_MAX_STEP:g} s"
        )
    if contact == "track" and master.algorithm is None:
        defaults = Master()
        unused = [
            f"master.{name}"
            for name in ("tolerance", "initial_step", "max_step")
            if getattr(master, name) != getattr(defaults, name)
        ]
        if unused:
            found.append(
                f"{', '.join(unused)} has no effect with contact on the track side, which steps "
                "without error control unless master.algorithm is newton"
            )
    return found


def _kinked(scenario: Scenario) -> list[str]:
    """Name the flat and the dents that have a kink."""
    shape = scenario.flat.shape
    return [f"the {shape}"] * (shape in KINKED) + [
        f"the {item.kind} of wheel {item.wheel}"
        for item in scenario.wheel_defect
        if isinstance(item, WheelFlat) and item.shape in KINKED
    ]
