"""What a user should know about a scenario that is allowed but may surprise."""

from __future__ import annotations

from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING

from track_fmu.window import MOVES_PER_LENGTH

from .master_section import DEFAULT_MAX_STEP, Master
from .sections import Flat
from .support_values import support_properties
from .unused_keys import unused_keys
from .wheel_sections import WheelFlat

if TYPE_CHECKING:
    from .scenario import Scenario
    from .signals import ContactSide

KINKED = ("parabola", "cusp", "chord")
"""Shapes of flats and other dents with a kink, at their tip or at their edges."""

PAIRS_PER_BAY_AT_KINKS = 8
"""Mode pairs per bay that resolve a kink; as verified, see docs/verification.md."""

SUPPORTS_PER_WHEEL = 10
"""Supports near a wheel that are enough where linear increments act; see docs/supports.md."""

FREE_BAYS = 6
"""Bays that a moving window should keep between its ends and the wheels; see docs/endless.md."""

STIFFNESSES = (
    "pad_stiffness_factor",
    "pad_damping_factor",
    "ballast_stiffness_factor",
    "ballast_damping_factor",
)
"""What of a support is linear in its deflection."""


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
    found += unused_keys(scenario)
    found += _of_the_model(scenario)
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


def _of_the_model(scenario: Scenario) -> list[str]:
    """Say where few supports act, or a window is hardly longer than the vehicle in it."""
    track, found = scenario.track, []
    fewest = min(SUPPORTS_PER_WHEEL, track.bays - 1)
    if track.supports_per_wheel < fewest and (
        track.ballast_mass > 0.0 or _stiffness_differs(scenario)
    ):
        found.append(
            f"supports that differ in stiffness, or ballast with a mass, act on more than the "
            f"{track.supports_per_wheel} nearest supports of a wheel: the contact force may be off "
            f"by 1 % of the static load; take track.supports_per_wheel={fewest}"
        )
    if track.endless:
        length = scenario.vehicle.offsets[-1] / track.sleeper_spacing
        bays = _free_bays(track.bays, length)
        if bays < FREE_BAYS:
            enough = next(n for n in count(track.bays) if _free_bays(n, length) >= FREE_BAYS)
            found.append(
                f"a window of {track.bays} bays leaves {max(bays, 0.0):.2g} of them between its "
                "clamped ends and a wheel: the contact force may be off by 7 % of the static load "
                f"and more; take track.bays={enough}"
            )
    return found


def _stiffness_differs(scenario: Scenario) -> bool:
    """Tell whether springs or dampers of supports are not all alike."""
    table = scenario.track.supports
    if table and not Path(table).is_file():
        return False  # of a run the table is read later, a result may have outlived its own
    own = support_properties(scenario)
    return any((own[name] != 1.0).any() for name in STIFFNESSES)


def _free_bays(bays: int, length: float) -> float:
    """Return the bays between a window's end and the nearest wheel when the window must move.

    Parameters
    ----------
    bays : int
        Of the window.
    length : float
        From the first wheel to the last one, in bays.
    """
    return 0.5 * (bays - length - max(1, bays // MOVES_PER_LENGTH) - 1)


def _kinked(scenario: Scenario) -> list[str]:
    """Name the flat and the dents that have a kink."""
    shape = scenario.flat.shape
    return [f"the {shape}"] * (shape in KINKED) + [
        f"the {item.kind} of wheel {item.wheel}"
        for item in scenario.wheel_defect
        if isinstance(item, WheelFlat) and item.shape in KINKED
    ]
