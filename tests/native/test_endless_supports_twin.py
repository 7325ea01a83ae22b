"""Native and numpy tracks whose supports differ without end agree, and so do sleepers that bend."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fmu_src.native.model_resources import track_resource

from .library import NativeError
from .test_endless_twin import MOVE, SPEED, STATIC_LOAD, offset
from .twins import assert_alike

PAD = str(Path(__file__).resolve().parents[2] / "examples" / "pad.csv")
HEADER = (
    "number,pad_stiffness_factor,pad_damping_factor,ballast_stiffness_factor,"
    "ballast_damping_factor,gap,fastened"
)


@pytest.fixture
def supports(tmp_path):
    """A table of sixty supports without order, every one of its own kind; some have no row."""
    random, table = np.random.default_rng(9), tmp_path / "supports.csv"
    lines = ["# without order", HEADER]
    for number in random.permutation(60) + 1:
        if number % 7:
            factors = ",".join(f"{value:.6f}" for value in random.uniform(0.5, 2.0, 4))
            hangs = number % 5 == 0
            lines.append(f"{number},{factors},{2e-4 * hangs},{int(hangs or number % 6 > 0)}")
    table.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return str(table)


def scaled(states, step):
    """Rates of forces as what these change in the step."""
    for name, mine, other in states:
        if name == "increment_rate":
            yield "force_change", mine * step, other * step
        else:
            yield name, mine, other


@pytest.mark.parametrize("ahead", [1.0, -1.0], ids=["forwards", "backwards"])
@pytest.mark.parametrize(
    "values", [{}, {"supports_repeat": True}, {"pad": PAD, "ballast_pulls": False}]
)
def test_step_by_step_over_supports_that_differ(track_pair, short_track, supports, values, ahead):
    """Out of the table at one end or the other; every step from numpy's state."""
    values = {"supports": supports} | values
    pair = track_pair(short_track, speed=ahead * SPEED, values=values, endless=True)
    positions = np.array([36.0, 34.2]) if ahead > 0.0 else np.array([9.0, 7.2])
    forces, random = np.full(2, STATIC_LOAD), np.random.default_rng(2)
    pair.start(positions, forces)
    assert_alike(pair.outputs(), relative=3e-12)
    first = offset(pair.native)
    for _ in range(100):
        positions = positions + ahead * 0.1
        pair.copy_state(pair.numpy.state)
        pair.step(2e-4, positions, forces * random.uniform(0.5, 1.5, 2))
        assert_alike(scaled(pair.states(), 2e-4), relative=5e-12)
    assert_alike(pair.outputs(), relative=5e-12)
    assert ahead * (offset(pair.native) - first) >= 5 * MOVE


def test_an_endless_table_is_that_of_single_supports(native, short_track, tmp_path):
    """Where the window has not moved, parameters and table, ordinary and endless are the same."""
    table = tmp_path / "supports.csv"
    table.write_text("position;gap;pad_stiffness_factor\n3.9; 1e-3; 0.5\n3.25;0;2\n")
    cases = (
        {"supports": str(table)},
        {"supports": str(table), "endless": True},
        {"support[6].gap": 1e-3, "support[6].pad_stiffness_factor": 0.5,
         "support[5].pad_stiffness_factor": 2.0},
        {"endless": True, "support[6].gap": 1e-3, "support[6].pad_stiffness_factor": 0.5,
         "support[5].pad_stiffness_factor": 2.0},
    )  # fmt: skip
    seen = []
    for values in cases:
        track = native("track", linear_inputs=True)
        for name, value in values.items():
            track.set_one(name, value)
        track.enter()
        track.set_group("wheel[#].position", [4.8, 3.0])
        track.exit()
        for _ in range(20):
            track.step(track.time, 1e-4)
        seen.append(track.group("ballast[#].force"))
    for other in seen[1:]:
        np.testing.assert_array_equal(other, seen[0])
    assert short_track.supports == len(seen[0])


def test_the_state_of_a_moved_window_is_restored_bit_for_bit_elsewhere(native, supports):
    """What supports have is no part of the state: it follows from the offset in it."""

    def go(track, start, count):
        for k in range(1, count + 1):
            track.set_group("wheel[#].position", np.array([start, start - 1.8]) + 0.05 * k)
            track.step(track.time, 2e-4)
        return start + 0.05 * count

    def make():
        track = native("track", linear_inputs=True, endless=True)
        for name, value in {"supports": supports, "pad": PAD, "ballast_pulls": False}.items():
            track.set_one(name, value)
        track.enter()
        track.set_group("wheel[#].position", np.array([12.0, 10.2]))
        track.exit()
        return track

    track = make()
    place = go(track, 12.0, 20)
    data, before = track.serialise(track.state), offset(track)
    go(track, place, 80)
    end, moved = track.state.tobytes(), offset(track)
    assert moved >= before + 2 * MOVE
    for other in (track, make()):
        other.state = other.deserialise(data)
        go(other, place, 80)
        assert other.state.tobytes() == end


def test_sleepers_that_bend_travel_with_the_window(track_pair, short_track):
    parameters = replace(short_track, sleeper="beam", sleeper_elements=4)
    resource = track_resource(parameters, wheels=2, gauges=2, mode_pairs=84)
    pair = track_pair(parameters, resource, speed=SPEED, endless=True)
    positions, random = np.array([100.2, 98.4]), np.random.default_rng(4)
    pair.start(positions, np.full(2, STATIC_LOAD))
    first = offset(pair.native)
    for ahead in (1.0, -1.0):
        for _ in range(150):
            positions = positions + ahead * SPEED * 5e-4
            pair.copy_state(pair.numpy.state)
            pair.step(5e-4, positions, STATIC_LOAD * random.uniform(0.5, 1.5, 2))
            assert_alike(scaled(pair.states(), 5e-4), relative=3e-12)
        assert_alike(pair.outputs(), relative=3e-12)
        assert ahead * (offset(pair.native) - first) >= MOVE * (ahead > 0.0)
    assert np.abs(pair.native.group("sleeper[#].bending_moment")).max() > 1e3


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "is empty; its first line must name the columns"),
        ("number,colour\n1,2\n", "column 'colour' is unknown or there twice"),
        ("number,gap,gap\n1,2,3\n", "column 'gap' is unknown or there twice"),
        ("gap\n1e-3\n", "must have one of the columns number and position"),
        ("number,position\n1,0.65\n", "must have one of the columns number and position"),
        ("number,gap\n1,-1\n", "line 2: gap is '-1', not a number of at least 0"),
        ("number,gap\n\n1,nan\n", "line 3: gap is 'nan', not a number of at least 0"),
        ("number,gap\n12,0\n", "names support 12 but the track has 11: correct it, or use more"),
        ("position;gap\n0.1;0\n", "names support 0 but the track has 11"),
        ("number,gap\n1,0\n1,0\n", "line 3: support 1 has a row already"),
        ("number,gap\n1.5,0\n", "number is 1.5, not a whole number"),
        ("number,fastened\n3,0.5\n", "line 2: fastened is '0.5', neither 1 nor 0"),
        ("number,gap\n1\n", "line 2: has 1 values, not 2 as the first line"),
        ("number,gap\n1,0,\n", "line 2: has 3 values, not 2 as the first line"),
    ],
)
def test_wrong_tables_are_refused_alike(native, track_pair, short_track, tmp_path, text, sentence):
    table = tmp_path / "supports.csv"
    table.write_text(text, encoding="utf-8")
    track = native("track", supports=str(table))
    with pytest.raises(NativeError, match=sentence):
        track.enter()
    with pytest.raises(ValueError, match=sentence):
        track_pair(short_track, values={"supports": str(table)})


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"supports_repeat": True}, "supports names no table that could be repeated"),
        ({"supports": "nowhere.csv"}, "nowhere.csv: cannot be read"),
        ({"supports": "x.csv", "support[3].gap": 1e-3}, r"but support\[i\].\* are given, too"),
    ],
)
def test_wrong_parameters_are_refused_alike(native, track_pair, short_track, values, sentence):
    track = native("track")
    for name, value in values.items():
        track.set_one(name, value)
    with pytest.raises(NativeError, match=sentence):
        track.enter()
    with pytest.raises(ValueError, match=sentence):
        track_pair(short_track, values=values)


def test_a_table_of_an_endless_track_has_a_limit(native, track_pair, short_track, tmp_path):
    table = tmp_path / "supports.csv"
    table.write_text("number,gap\n2000001,1e-3\n", encoding="utf-8")
    track = native("track", supports=str(table), endless=True)
    sentence = "names support 2000001 but it may go up to 2000000"
    with pytest.raises(NativeError, match=sentence):
        track.enter()
    with pytest.raises(ValueError, match=sentence):
        track_pair(short_track, values={"supports": str(table)}, endless=True)
