"""The numbers of a case: those of the summary that do not differ from run to run."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..signals import COMPRESSION, DOWN, FORWARDS, SAGGING
from ..summary import CAUSES, summarise

if TYPE_CHECKING:
    import xarray as xr

_FLAT_WHEEL = "of the flat's wheel, 0.1 m before to 0.8 m after the flat's centre"

NUMBERS: dict[str, tuple[str, str, str]] = {
    "peak_contact_force": ("N", f"largest contact force {_FLAT_WHEEL}", COMPRESSION),
    "peak_contact_force_position": (
        "m",
        "distance from the flat's centre at the largest contact force",
        FORWARDS,
    ),
    "min_contact_force": ("N", f"smallest contact force {_FLAT_WHEEL}", COMPRESSION),
    "loss_of_contact_time": ("s", f"time without contact {_FLAT_WHEEL}", "none"),
    "max_sleeper_displacement": ("m", "largest displacement of any sleeper", DOWN),
    "peak_bending_moment_midspan": (
        "N m",
        "largest bending moment of the rail in the middle of the struck bay",
        SAGGING,
    ),
    "peak_bending_moment_under_wheel": (
        "N m",
        "largest bending moment of the rail under the flat's wheel",
        SAGGING,
    ),
    "simulated_time": ("s", "simulated time", "none"),
    "steps_accepted": ("1", "accepted steps", "none"),
    **{
        f"steps_rejected_{cause}": ("1", f"attempts rejected because of {cause}", "none")
        for cause in CAUSES
    },
    "iterations": ("1", "coupling iterations of all attempts", "none"),
}
"""Units, long name and sign of every number."""


def numbers_of(passage: xr.Dataset) -> dict[str, float]:
    """Compute the `NUMBERS` of a complete passage.

    Raises
    ------
    ValueError
        Where the passage has not reached the flat.
    """
    summary = summarise(passage)
    steps = summary.steps
    rejected = {f"steps_rejected_{cause}": number for cause, number in steps.rejected.items()}
    known = {
        **{name: getattr(summary, name) for name in NUMBERS if hasattr(summary, name)},
        **rejected,
        "steps_accepted": steps.accepted,
        "iterations": steps.iterations,
    }
    missing = [name for name in NUMBERS if known[name] is None]
    if missing:
        raise ValueError(f"the passage ends before there is a {missing[0]}")
    return {name: float(known[name]) for name in NUMBERS}
