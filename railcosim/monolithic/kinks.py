"""When something that is given of a passage is not smooth, so that an integration begins anew."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from vehicle_fmu.speed import ConstantSpeed

from ..input_tables import read_flat
from ..motion import travel_time
from ..rail_sections import Joint
from ..wheel_sections import WheelFlat
from .drops import turn_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from vehicle_fmu.speed import SpeedLaw

    from ..scenario import Scenario
    from ..surfaces.tables import UnevenSurfaces

CLOSE = 1e-9
"""Kinks nearer to each other than this are one [s]."""


def kinks_on_the_way(
    scenario: Scenario, surfaces: UnevenSurfaces, law: SpeedLaw, starts: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the times of all kinks strictly between the start and the end of the way [s].

    A wheel passes a node of the rail, where the slope of the deflection jumps; both ends or the
    centre of a flat, another dent of its tread, or a joint of the rail; an end of the table of the
    rail; or the speed has a corner. The curves through the tables themselves have continuous slopes
    and are left to the integrator.

    Parameters
    ----------
    scenario : Scenario
        What passes.
    surfaces : UnevenSurfaces
        Its tables.
    law : SpeedLaw
        Way over time.
    starts : ndarray, shape (wheels,)
        Positions of the wheels at t = 0 [m].
    """
    ways = np.concatenate(
        [
            points - start
            for wheel, start in enumerate(starts.tolist(), start=1)
            for points in (
                _nodes(scenario, start),
                _rail_points(scenario, surfaces),
                _tread_points(scenario, wheel, start),
            )
        ]
    )
    inside = np.sort(ways[(ways > 0.0) & (ways < scenario.distance)])
    times = np.array([travel_time(law, way) for way in inside.tolist()])
    if not isinstance(law, ConstantSpeed):
        times = np.sort(np.append(times, law.time))
    stop = travel_time(law, scenario.distance)
    times = times[(times > CLOSE) & (times < stop)]
    return times[np.diff(times, append=stop) > CLOSE]


def _nodes(scenario: Scenario, start: float) -> NDArray[np.float64]:
    """Positions of the rail's nodes that a wheel passes [m]."""
    spacing = scenario.track.sleeper_spacing / scenario.track.elements_per_bay
    first, last = start / spacing, (start + scenario.distance) / spacing
    return spacing * np.arange(math.ceil(first), math.floor(last) + 1, dtype=np.float64)


def _rail_points(scenario: Scenario, surfaces: UnevenSurfaces) -> NDArray[np.float64]:
    """Positions of joints, and of both ends of the table of the rail [m]."""
    joints = [
        item.position + share * item.length
        for item in scenario.irregularity
        if isinstance(item, Joint)
        for share in (-0.5, 0.0, 0.5)
    ]
    ends = [] if surfaces.rail is None else surfaces.rail.position[[0, -1]].tolist()
    return np.array(joints + ends)


def _tread_points(scenario: Scenario, wheel: int, start: float) -> NDArray[np.float64]:
    """Positions where edges and centres of the dents of a wheel meet the rail [m]."""
    turn = turn_of(scenario)
    turns = turn * np.arange(
        math.floor((start - scenario.flat_position) / turn) - 1,
        math.ceil((start + scenario.distance - scenario.flat_position) / turn) + 2,
    )
    dents = [
        item.angle_deg / 360.0 % 1.0 * turn + share * item.length
        for item in scenario.wheel_defect
        if item.wheel == wheel and isinstance(item, WheelFlat)
        for share in (-0.5, 0.0, 0.5)
    ]
    points = [dent + turns for dent in dents]
    if wheel == scenario.flat.wheel:
        again = turns if scenario.flat.periodic else np.zeros(1)
        points += [edge + again for edge in _flat_points(scenario)]
    return scenario.flat_position + np.concatenate([*points, np.empty(0)])


def _flat_points(scenario: Scenario) -> tuple[float, ...]:
    """Edges and centre of the flat, from its centre [m]; none without a flat."""
    flat, table = read_flat(scenario)
    if table is not None:
        return float(table.distance[0]), 0.0, float(table.distance[-1])
    return () if flat.shape == "none" else (-0.5 * flat.length, 0.0, 0.5 * flat.length)
