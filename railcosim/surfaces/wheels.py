"""The treads that the wheel defects of a scenario add up to."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from vehicle_fmu.out_of_roundness import FULL_TURN, OutOfRoundness

from ..errors import InputError
from ..input_tables import read_as
from ..irregularity.contact_filter import filter_around
from ..irregularity.wheel_defects import dent, polygon
from ..wheel_sections import MeasuredWheel, Polygon, Spall, WheelFlat
from .rail import POINTS_PER_WAVE, check_points, semi_axis

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..scenario import Scenario
    from ..wheel_sections import WheelSection

POINTS_PER_DENT, WIDEST = 100, 5e-4
"""Points in a flat or spall, but at most half a millimetre apart [m]."""


def compose_treads(scenario: Scenario) -> tuple[OutOfRoundness | None, ...]:
    """Add up the defects of every wheel.

    Returns
    -------
    tuple of OutOfRoundness or None
        One a wheel, None for a round one, all over the same angles; empty where all are round.

    Raises
    ------
    InputError
        For a table that cannot be used, or a dent that does not fit on its wheel.
    """
    if not scenario.wheel_defect:
        return ()
    radius = scenario.vehicle.wheel_radius
    measured = {
        item.file: read_as(OutOfRoundness, item.file, ("angle", "drop"))
        for item in scenario.wheel_defect
        if isinstance(item, MeasuredWheel)
    }
    spacing = min(_spacing(item, radius, measured) for item in scenario.wheel_defect)
    points = check_points(FULL_TURN * radius, spacing, "the tread")
    angle = FULL_TURN / points * np.arange(points, dtype=np.float64)
    return tuple(
        _tread(scenario, wheel, angle, measured) for wheel in range(1, scenario.vehicle.wheels + 1)
    )


def _spacing(item: WheelSection, radius: float, measured: dict[str, OutOfRoundness]) -> float:
    """Return how far apart points may be along the tread [m]."""
    match item:
        case Polygon():
            return FULL_TURN * radius / (item.order * POINTS_PER_WAVE)
        case WheelFlat() | Spall():
            return min(item.length / POINTS_PER_DENT, WIDEST)
        case _:
            angle = measured[item.file].angle
            return radius * float(np.diff(np.append(angle, angle[0] + FULL_TURN)).min())


def _tread(
    scenario: Scenario,
    wheel: int,
    angle: NDArray[np.float64],
    measured: dict[str, OutOfRoundness],
) -> OutOfRoundness | None:
    """Add up the defects of one wheel; dents are not what the contact patch averages out."""
    mine = [item for item in scenario.wheel_defect if item.wheel == wheel]
    if not mine:
        return None
    radius = scenario.vehicle.wheel_radius
    waves, dents = np.zeros_like(angle), np.zeros_like(angle)
    for item in mine:
        match item:
            case Polygon():
                phase = math.radians(item.phase_deg)
                waves += polygon(
                    angle, order=item.order, amplitude=item.wave_amplitude, phase=phase
                )
            case WheelFlat() | Spall():
                dents += _dent(item, angle, radius)
            case _:
                curve = measured[item.file].curve()
                waves += item.scale * np.array([curve(a) for a in angle.tolist()])
    if scenario.surface.contact_filter:
        spacing = FULL_TURN * radius / angle.size
        waves = filter_around(waves, spacing=spacing, semi_axis=semi_axis(scenario))
    return OutOfRoundness(angle=angle, drop=waves + dents)


def _dent(item: WheelFlat, angle: NDArray[np.float64], radius: float) -> NDArray[np.float64]:
    try:
        return dent(
            angle,
            centre=math.radians(item.angle_deg),
            length=item.length,
            depth=item.depth,
            shape=item.shape,
            rolled=item.rolled,
            radius=radius,
        )
    except ValueError as error:
        raise InputError(f"wheel_defect of wheel {item.wheel}: {error}") from error
