"""What is given of the wheels: their surfaces, and when these are not smooth."""

import math

import numpy as np
import pytest

from railcosim.input_tables import read_flat
from railcosim.monolithic.course import course_of
from railcosim.monolithic.drops import Drops
from railcosim.scenario_file import from_toml, read_scenario
from railcosim.surfaces.tables import compose
from vehicle_fmu.surfaces import Surfaces

RADIUS = 0.45
TURN = 2.0 * math.pi * RADIUS
UNEVEN = """
[surface]
contact_filter = true

[flat]
wheel = 2
periodic = true
shape = "parabola"
rolled = true

[[irregularity]]
kind = "iso3095"

[[irregularity]]
kind = "joint"
position = 16.9

[[wheel_defect]]
kind = "polygon"
order = 3
amplitude = 1e-4

[[wheel_defect]]
kind = "spall"
angle_deg = 300

[[wheel_defect]]
kind = "flat"
wheel = 2
angle_deg = 120
"""


def test_drops_are_those_that_the_vehicle_sees():
    """Another's curves through the same tables; seams of treads and ends of the rail included."""
    scenario = from_toml(UNEVEN)
    surfaces, (flat, table) = compose(scenario), read_flat(scenario)
    theirs = Surfaces(
        flat,
        flat_table=table,
        irregularity=surfaces.rail,
        out_of_roundness=surfaces.treads,
        wheels=2,
        radius=RADIUS,
    )
    ours = Drops(scenario, surfaces)
    position = np.linspace(12.0, 20.0, 4001)
    seen = np.array([ours.at(np.array([x, x - 1.8])) for x in position])
    expected = np.array([theirs.drops(np.array([x, x - 1.8])) for x in position])
    assert np.ptp(expected, axis=0).min() > 1e-4
    # rounding of positions of 20 m, on slopes of up to 0.1
    assert seen == pytest.approx(expected, abs=1e-14)


def kinks(toml, *, speed=10.0):
    """Ways of the leading wheel to all kinks but nodes of the rail [m]."""
    scenario = from_toml(f"[vehicle]\nspeed_kmh = {3.6 * speed}\n[run]\napproach = 2\n{toml}")
    course = course_of(scenario, compose(scenario))
    nodes = (course.starts[:, None] + speed * course.kinks) / (0.65 / 8)
    off = np.abs(nodes - np.round(nodes)).min(axis=0) > 1e-6
    return scenario, speed * course.kinks[off]


def test_a_dent_is_met_at_every_turn_by_its_wheel():
    _, ways = kinks(
        """
        departure = 4
        [flat]
        shape = "none"
        [[wheel_defect]]
        kind = "flat"
        wheel = 2
        length = 0.06
        angle_deg = 90
        """
    )
    centres = 3.8 + 0.25 * TURN + TURN * np.arange(-1, 1)
    expected = (centres[:, None] + [-0.03, 0.0, 0.03]).ravel()
    inside = expected[(expected > 0.0) & (expected < 6.0)]
    assert ways == pytest.approx(inside, abs=1e-9)


def test_every_wheel_meets_a_joint_and_the_onset_of_an_uneven_rail():
    scenario, ways = kinks(
        """
        [flat]
        shape = "none"
        [[irregularity]]
        kind = "joint"
        position = 16.91
        length = 0.5
        """
    )
    start = scenario.start_position
    points = [16.91 - 0.25 - start, 16.91 - start, 16.91 + 0.25 - start]
    expected = sorted([*points, *(1.8 + way for way in points), 1.8])
    assert ways == pytest.approx(expected, abs=1e-9)


def test_a_table_of_speeds_has_kinks(tmp_path):
    table = tmp_path / "speed.csv"
    table.write_text("time,speed\n0,10\n0.05,10\n0.1,12\n", encoding="utf-8")
    keys = (f"vehicle.speed_table={table}", "flat.shape=none", "run.approach=1", "run.departure=1")
    scenario = read_scenario(None, keys)
    course = course_of(scenario, compose(scenario))
    assert {0.05, 0.1} <= set(course.kinks.tolist())
    # 0.5 m, then 0.55 m in the second 50 ms, then on at 12 m/s
    assert course.stop_time == pytest.approx(0.1 + 0.95 / 12.0, abs=1e-9)
    assert course.speed(0.075) == pytest.approx(11.0)
