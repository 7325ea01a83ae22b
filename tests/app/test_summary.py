import json

import numpy as np
import pytest

from railcosim.scenario import Scenario
from railcosim.sections import Flat
from railcosim.summary import summarise

DISTANCE = np.array([-3.9, -0.2, 0.0, 0.04, 0.1, 0.2, 0.7, 0.9, 2.6])


def test_forces_are_those_of_the_window_with_its_ends_on_straight_lines(make_passage):
    force = np.array([900.0, 300.0, 100.0, 500.0, 0.0, 100.0, 100.0, 700.0, 900.0])
    summary = summarise(make_passage(DISTANCE, series={"contact_force": {1: force, 2: 1e9}}))
    assert summary.peak_contact_force == 500.0
    assert summary.peak_contact_force_position == pytest.approx(0.04, abs=1e-12)
    assert summary.min_contact_force == 0.0
    # Without the inner peak the largest one is at the end of the window, halfway from 0.7 to 0.9 m.
    force[3] = 0.0
    summary = summarise(make_passage(DISTANCE, series={"contact_force": {1: force}}))
    assert summary.peak_contact_force == pytest.approx(400.0, rel=1e-12)
    assert summary.peak_contact_force_position == pytest.approx(0.8, abs=1e-12)


def test_loss_of_contact_counts_the_time_with_an_open_gap_inside_the_window(make_passage):
    gap = np.array([-1.0, 1.0, 1.0, -1.0, 1.0, -1.0, -1.0, -1.0, 1.0])
    summary = summarise(make_passage(DISTANCE, series={"gap": {1: gap}}))
    open_distance = (0.02 + 0.1) + (0.15 - 0.07)
    speed = Scenario().vehicle.constant_speed
    assert summary.loss_of_contact_time == pytest.approx(open_distance / speed, rel=1e-12)


def test_sleeper_displacement_is_the_largest_of_the_whole_run(make_passage):
    moved = np.zeros(DISTANCE.size)
    moved[0] = 4e-4
    summary = summarise(make_passage(DISTANCE, series={"sleeper_displacement": {17: moved}}))
    assert summary.max_sleeper_displacement == 4e-4


def test_moments_are_those_of_gauge_1_and_of_the_flats_wheel(make_passage):
    inside = np.where(np.abs(DISTANCE - 0.04) < 1e-9, 1.0, 0.0)
    series = {
        "bending_moment": {1: 3e4 * inside, 2: 9e4 * inside},
        "bending_moment_under_wheel": {1: 9e4 * inside, 2: 4e4 * inside},
    }
    summary = summarise(make_passage(DISTANCE, Scenario(flat=Flat(wheel=2)), series=series))
    assert summary.peak_bending_moment_midspan == 3e4
    assert summary.peak_bending_moment_under_wheel == 4e4


def test_what_an_interrupted_run_has_not_reached_is_null_in_json(make_passage):
    summary = summarise(make_passage([-3.9, -2.0], complete=False))
    document = json.loads(json.dumps(summary.as_dict(), allow_nan=False))
    assert document["peak_contact_force"] is None
    assert document["peak_contact_force_position"] is None
    assert document["min_contact_force"] is None
    assert document["loss_of_contact_time"] is None
    assert document["peak_bending_moment_midspan"] is None
    assert document["peak_bending_moment_under_wheel"] is None
    assert document["max_sleeper_displacement"] == 0.0


def test_a_run_that_ends_inside_the_window_has_the_numbers_up_to_there(make_passage):
    summary = summarise(make_passage([-3.9, 0.1], series={"contact_force": {1: [0.0, 4.0]}}))
    assert summary.peak_contact_force == 4.0
    assert summary.min_contact_force == pytest.approx(3.8, rel=1e-12)


def test_json_has_the_keys_of_the_command_line(make_passage):
    document = summarise(make_passage(DISTANCE)).as_dict()
    assert list(document) == [
        "peak_contact_force",
        "peak_contact_force_position",
        "min_contact_force",
        "loss_of_contact_time",
        "max_sleeper_displacement",
        "peak_bending_moment_midspan",
        "peak_bending_moment_under_wheel",
        "steps",
        "simulated_time",
        "wall_time",
        "warnings",
        "unreliable",
    ]
    assert document["steps"] == {
        "accepted": DISTANCE.size - 1,
        "rejected": {"error": 0, "event": 1, "convergence": 2, "discard": 3, "invalid": 4},
        "iterations": 7,
    }
