"""Passages on endless tracks whose supports differ, against ordinary ones that hold the way."""

import numpy as np
import pytest

from railcosim.passage import run_passage
from railcosim.scenario_file import read_scenario
from railcosim.support_values import support_properties

STATIC_LOAD = 117_720.0
SPACING = 0.65
RANDOM = (
    "variation.seed=4",
    "variation.correlation_length=2.0",
    "variation.pad_stiffness_deviation=0.2",
    "variation.ballast_stiffness_deviation=0.4",
    "track.supports_per_wheel=12",
)


def run(tmp_path, *keys):
    return run_passage(
        read_scenario(None, keys), fmus="native", contact="track", directory=tmp_path
    )


def force_at(result, positions):
    return np.interp(
        positions,
        result["wheel_position"].sel(wheel=1).to_numpy(),
        result["contact_force"].sel(wheel=1).to_numpy(),
    )


def test_random_supports_are_the_same_however_many_there_are():
    ordinary = support_properties(read_scenario(None, RANDOM))
    endless = support_properties(
        read_scenario(None, (*RANDOM, "track.endless=true", "run.departure=2000"))
    )
    for name, values in ordinary.items():
        assert len(values) == 49
        assert len(endless[name]) > 3100
        assert np.array_equal(endless[name][:49], values)


@pytest.mark.slow
def test_the_force_is_that_on_an_ordinary_track_that_holds_the_whole_way(tmp_path):
    """What remains are waves of 1 kHz between the ends of the window and of the long track."""
    way = ("flat.position=40.0", "run.approach=22.0", "run.departure=10.0", "flat.depth=0.5e-3")
    bays = ("track.bays=110", "track.mode_pairs=330")
    endless = run(tmp_path, *way, *RANDOM, "track.endless=true")
    ordinary = run(tmp_path, *way, *RANDOM, *bays)
    uniform = run(tmp_path, *way, "track.endless=true")
    positions = np.linspace(19.0, 49.0, 30_001)
    ours, theirs, level = (force_at(r, positions) for r in (endless, ordinary, uniform))
    assert ours == pytest.approx(theirs, abs=2e-3 * STATIC_LOAD)
    assert np.abs(ours - level).max() > 0.3 * STATIC_LOAD


def test_a_hanging_sleeper_far_out_hangs_where_it_is(tmp_path):
    """Number 205, and on an ordinary track number 25, a hundred and eighty bays before."""
    gap, far, near = 0.5e-3, 205, 25
    way = ("flat.shape=none", "run.departure=2.0", f"variation.hanging_gap={gap}")
    common = (*way, "track.supports_per_wheel=12")
    runs = [
        run(
            tmp_path,
            *common,
            f"variation.hanging_sleepers={number}",
            f"flat.position={number * SPACING}",
            *keys,
        )
        for number, keys in (
            (far, ("track.endless=true", "run.approach=12.0")),
            (near, ("run.approach=4.0",)),
        )
    ]
    depth = [result["sleeper_displacement"].max("time") for result in runs]
    places = depth[0]["sleeper_position"].to_numpy()
    passed = (places > far * SPACING - 4.0) & (places < far * SPACING + 0.1)
    deepest = int(np.argmax(np.where(passed, depth[0], 0.0)))
    assert places[deepest] == pytest.approx(far * SPACING)
    assert float(depth[0][deepest]) > gap
    assert np.count_nonzero(depth[0].to_numpy()[passed] > gap) == 1
    along = np.linspace(-1.5, 1.8, 3301)
    ours, theirs = (
        force_at(result, number * SPACING + along)
        for result, number in zip(runs, (far, near), strict=True)
    )
    assert ours == pytest.approx(theirs, abs=5e-3 * STATIC_LOAD)
    assert np.ptp(theirs) > 0.03 * STATIC_LOAD
