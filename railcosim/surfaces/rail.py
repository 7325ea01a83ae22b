"""The rail that the irregularities of a scenario add up to."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from vehicle_fmu.contact_patch import patch_semi_axis
from vehicle_fmu.irregularity import RailIrregularity

from ..errors import InputError
from ..input_tables import read_rail
from ..irregularity.contact_filter import filter_along
from ..irregularity.rail_defects import corrugation, dip
from ..irregularity.spectra import fra, german, iso3095
from ..irregularity.synthesis import random_profile, signal_points
from ..irregularity.windows import onset, stretch
from ..rail_sections import (
    Corrugation,
    FraTrack,
    GermanTrack,
    Iso3095Roughness,
    Joint,
    MeasuredRail,
)
from ..vehicle_section import RAIL_RADIUS

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from ..rail_sections import RailSection
    from ..scenario import Scenario

MOST_POINTS = 2_000_000
"""Points of a table that an FMU still reads in a few seconds."""

MOST_POINTS_OF_A_SIGNAL = 2**22
"""Points of a random signal that is made in a second."""

COARSEST = 0.05
"""Largest spacing of a composed rail [m]."""

POINTS_PER_WAVE = 40
"""Points in a sine; the models' curves then flatten its crests by 0.3 %."""

POINTS_PER_SHORTEST_WAVE = 10
"""Points in the shortest of many waves; it loses 0.3 dB to the models' curves, the others less."""

POINTS_PER_DIP = 1000
"""Points in a dip of the rail, whose kink would lose its bottom between fewer."""

BEHIND_THE_END = 0.5
"""How far a composed rail reaches beyond the way of the wheels [m]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Part:
    """One irregularity as a function of the position, and how finely it must be tabulated [m]."""

    profile: Callable[[NDArray[np.float64]], NDArray[np.float64]]
    spacing: float


def compose_rail(scenario: Scenario) -> RailIrregularity | None:
    """Add up the irregularities of a scenario, or read the one table that it names.

    Behind the start of the leading wheel the rail is smooth, so that every wheel starts at rest;
    from there on the sum, counted from its value there, sets in over ``surface.ramp``.

    Returns
    -------
    RailIrregularity or None
        None for a smooth rail.

    Raises
    ------
    InputError
        For a table that cannot be used, or one that would be too long.
    """
    file = scenario.vehicle.rail_irregularity
    if file:
        return read_rail(file)
    if not scenario.irregularity:
        return None
    parts = [
        _part(item, max(scenario.track.length, scenario.distance)) for item in scenario.irregularity
    ]
    spacing = min(COARSEST, *(part.spacing for part in parts))
    position = _positions(scenario, spacing)
    drop = np.zeros_like(position)
    for part in parts:
        drop += part.profile(position)
    if scenario.surface.contact_filter:
        drop = filter_along(drop, spacing=spacing, semi_axis=semi_axis(scenario))
    drop = (drop - drop[0]) * onset(position - position[0], scenario.surface.ramp)
    return RailIrregularity(position=position, drop=drop)


def semi_axis(scenario: Scenario) -> float:
    """Return half the length of the contact patch under the static wheel load [m]."""
    vehicle = scenario.vehicle
    return patch_semi_axis(
        force=vehicle.static_wheel_load,
        wheel_radius=vehicle.wheel_radius,
        rail_radius=RAIL_RADIUS if vehicle.rail_radius is None else vehicle.rail_radius,
        youngs_modulus=vehicle.youngs_modulus,
        poissons_ratio=vehicle.poissons_ratio,
    )


def check_points(length: float, spacing: float, what: str) -> int:
    """Return how many intervals of this spacing a length has.

    Raises
    ------
    InputError
        If there were more than `MOST_POINTS`.
    """
    intervals = math.ceil(length / spacing)
    if intervals > MOST_POINTS:
        raise InputError(
            f"{what} of {length:g} m takes {intervals} points {spacing:.3g} m apart, but at most "
            f"{MOST_POINTS} can be used: leave the shortest waves out or run a shorter way"
        )
    return intervals


def _positions(scenario: Scenario, spacing: float) -> NDArray[np.float64]:
    """Return equidistant positions from the start of the leading wheel beyond its end [m]."""
    length = scenario.distance + BEHIND_THE_END
    points = check_points(length, spacing, "the irregularity") + 1
    return scenario.start_position + spacing * np.arange(points, dtype=np.float64)


def _part(item: RailSection, length: float) -> Part:
    """Turn a table of the scenario into its function; random ones repeat beyond a length [m]."""
    match item:
        case Joint():
            return _dip(item)
        case Corrugation():
            whole = _sine(item)
        case MeasuredRail():
            whole = _measured(item)
        case _:
            whole = _random(item, length)
    return Part(
        profile=lambda x: (
            whole.profile(x) * stretch(x, begin=item.begin, end=item.end, taper=item.taper)
        ),
        spacing=whole.spacing,
    )


def _dip(item: Joint) -> Part:
    drop = partial(
        dip, centre=item.position, length=item.length, depth=item.largest_drop, shape=item.shape
    )
    return Part(profile=drop, spacing=item.length / POINTS_PER_DIP)


def _sine(item: Corrugation) -> Part:
    phase = math.radians(item.phase_deg)
    drop = partial(corrugation, wavelength=item.wavelength, depth=item.depth, phase=phase)
    return Part(profile=drop, spacing=item.wavelength / POINTS_PER_WAVE)


def _measured(item: MeasuredRail) -> Part:
    """Take the curve through a table, at points no further apart than its own: nothing aliases."""
    table = read_rail(item.file, item.scale)
    curve, scale = table.curve(), item.scale

    def drop(x: NDArray[np.float64]) -> NDArray[np.float64]:
        return scale * np.array([curve(p) for p in x.tolist()])

    return Part(profile=drop, spacing=float(np.diff(table.position).min()))


def _random(item: Iso3095Roughness | GermanTrack | FraTrack, length: float) -> Part:
    match item:
        case Iso3095Roughness():
            spectrum = iso3095(item.level_db)
        case GermanTrack():
            spectrum = german(item.disturbance)
        case _:
            spectrum = fra(item.track_class)
    waves = {
        "shortest": item.shortest_wavelength,
        "longest": item.longest_wavelength,
        "length": length,
    }
    points = signal_points(**waves)
    if points > MOST_POINTS_OF_A_SIGNAL:
        raise InputError(
            f"waves from {item.shortest_wavelength:g} to {item.longest_wavelength:g} m take "
            f"{points} points, but at most {MOST_POINTS_OF_A_SIGNAL} can be used: leave the "
            "shortest out, or divide them into two tables [[irregularity]] of the same kind"
        )

    def drop(x: NDArray[np.float64]) -> NDArray[np.float64]:
        return random_profile(spectrum, **waves, seed=item.seed)(x)

    return Part(profile=drop, spacing=item.shortest_wavelength / POINTS_PER_SHORTEST_WAVE)
