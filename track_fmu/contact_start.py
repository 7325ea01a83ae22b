"""What a vehicle and a track that has the contacts tell each other about the start."""

from __future__ import annotations

import math

import numpy as np

from .beam_element import FloatArray
from .contact_law import Surface
from .contact_state import ContactState

INSTANT = 1e-6  # s, over which the rate of a surface is taken at the start
SWAY = 1.0  # s, over which bodies above the wheels smooth it; about a period of car bodies


def surface_rate(
    surface: Surface, positions: FloatArray, *, speed: float, span: float
) -> FloatArray:
    """Return how fast the surface sinks under rolling wheels [m/s], shape (wheels,).

    Parameters
    ----------
    surface : Surface
        Drops of tread and railhead.
    positions : (wheels,) float array
        Of the wheels [m].
    speed, span : float
        Of the wheels [m/s]; time over which the mean is taken, half of it before [s].
    """
    half = 0.5 * span * speed
    rate: FloatArray = (surface.drops(positions + half) - surface.drops(positions - half)) / span
    return rate


def check_start_inputs(load_changes: FloatArray, velocities: FloatArray) -> None:
    """Raise ValueError unless what the vehicle tells of its start [N, m/s] are numbers."""
    for number, (change, velocity) in enumerate(zip(load_changes, velocities, strict=True), 1):
        if not (math.isfinite(change) and math.isfinite(velocity)):
            raise ValueError(
                f"track: load change {float(change):g} N and velocity {float(velocity):g} m/s of "
                f"wheel {number} must be finite numbers; look for the cause in the vehicle"
            )


def check_loads(loads: FloatArray) -> None:
    """Raise ValueError unless every wheel presses on the rail [N]."""
    for number, load in enumerate(loads, start=1):
        if load < 0.0:
            raise ValueError(
                f"track: wheel {number} starts with a load of {float(load):g} N, which must be at "
                "least 0: begin where the rail is more even, or let the vehicle have the contacts"
            )


def check_displacements(displacements: FloatArray) -> None:
    """Raise ValueError unless every displacement of a wheel [m] is a number."""
    for number, displacement in enumerate(displacements, start=1):
        if not math.isfinite(displacement):
            raise ValueError(
                f"track: displacement {float(displacement)!r} m of wheel {number} must be a finite "
                "number; look for the cause in the vehicle"
            )


def first_step_doubts(
    own: ContactState, step_size: float, positions: FloatArray, *, longest: float
) -> list[str]:
    """Return what is doubtful about a first step [s] of given start values, a sentence each."""
    found: list[str] = []
    if own.passed[0] > 0.0:
        return found
    if step_size > longest * (1.0 + 1e-9):
        found.append(
            f"steps of {step_size:.6g} s are too long for values that are known at their start "
            f"only: use {longest:g} s or less"
        )
    if not np.array_equal(own.history[0, : len(positions)], positions):
        found.append(
            f"at the start of the first step wheel 1 is at {positions[0]:.9g} m, at the static "
            f"start it was at {own.history[0, 0]:.9g} m: set linear_inputs = true in a host "
            "that steps the vehicle first, or the start values of the positions in one that "
            "connects nothing before the first step"
        )
    return found
