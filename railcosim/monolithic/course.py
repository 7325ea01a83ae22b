"""What is given of the wheels: where they are at which time, and what they roll over."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from vehicle_fmu.speed import ConstantSpeed
from vehicle_fmu.surfaces import Surfaces

from ..input_tables import read_flat, read_irregularity
from ..motion import speed_law, travel_time

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from vehicle_fmu.speed import SpeedLaw

    from ..scenario import Scenario

CLOSE = 1e-9
"""Kinks nearer to each other than this are one [s]."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Course:
    """The prescribed way of all wheels over the rail.

    Attributes
    ----------
    law : SpeedLaw
        Way over time.
    starts : ndarray, shape (wheels,)
        Positions at t = 0 [m].
    surfaces : Surfaces
        Drops of treads and railhead.
    stop_time : float
        When the way is done [s].
    kinks : ndarray, shape (k,)
        Times strictly between 0 and the end at which something given is not smooth [s]: a wheel
        passes a node of the rail, where the slope of the deflection jumps, or a flat begins, has
        its centre or ends.
    """

    law: SpeedLaw
    starts: NDArray[np.float64]
    surfaces: Surfaces
    stop_time: float
    kinks: NDArray[np.float64]

    def positions(self, time: float) -> NDArray[np.float64]:
        """Return the positions of the wheels [m], shape (wheels,)."""
        return self.starts + self.law.distance(0.0, time)

    def speed(self, time: float) -> float:
        """Return the speed of all wheels [m/s]."""
        if isinstance(self.law, ConstantSpeed):
            return self.law.speed
        return float(np.interp(time, self.law.time, self.law.speed))

    def drops(self, time: float) -> NDArray[np.float64]:
        """Return what treads and railhead lie lower under each wheel [m], shape (wheels,)."""
        return self.surfaces.drops(self.positions(time))


def course_of(scenario: Scenario) -> Course:
    """Return the way of a scenario's wheels.

    Raises
    ------
    InputError
        For a table that cannot be read or does not fit.
    """
    law = speed_law(scenario.vehicle)
    flat, table = read_flat(scenario)
    vehicle = scenario.vehicle
    starts: NDArray[np.float64] = scenario.start_position - np.array(vehicle.offsets)
    begins, ends = 0.0, 0.0
    if flat.shape == "table" and table is not None:
        begins, ends = float(table.distance[0]), float(table.distance[-1])
    elif flat.shape != "none":
        begins, ends = -0.5 * flat.length, 0.5 * flat.length
    ways = _nodes_on_the_way(scenario, starts)
    if flat.shape != "none":
        start = float(starts[flat.wheel - 1])
        for centre in _strikes(scenario, start):
            ways += [centre + edge - start for edge in (begins, 0.0, ends)]
    inside = sorted(way for way in ways if 0.0 < way < scenario.distance)
    times = np.array([travel_time(law, way) for way in inside])
    stop = travel_time(law, scenario.distance)
    if times.size:
        times = times[np.diff(times, append=stop) > CLOSE]
    return Course(
        law=law,
        starts=starts,
        surfaces=Surfaces(
            flat,
            flat_table=table,
            irregularity=read_irregularity(scenario),
            wheels=vehicle.wheels,
            radius=vehicle.wheel_radius,
        ),
        stop_time=stop,
        kinks=times[times > CLOSE],
    )


def _nodes_on_the_way(scenario: Scenario, starts: NDArray[np.float64]) -> list[float]:
    """Return the ways after which a wheel stands on a node of the rail [m]."""
    spacing = scenario.track.sleeper_spacing / scenario.track.elements_per_bay
    return [
        node * spacing - start
        for start in starts.tolist()
        for node in range(
            math.ceil(start / spacing), math.floor((start + scenario.distance) / spacing) + 1
        )
    ]


def _strikes(scenario: Scenario, start: float) -> list[float]:
    """Return where the flat's centre may meet the rail on the way, and one turn around it [m]."""
    if not scenario.flat.periodic:
        return [scenario.flat_position]
    turn = 2.0 * math.pi * scenario.vehicle.wheel_radius
    first = math.floor((start - scenario.flat_position) / turn)
    last = math.ceil((start + scenario.distance - scenario.flat_position) / turn)
    return [scenario.flat_position + k * turn for k in range(first, last + 1)]
