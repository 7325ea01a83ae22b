"""Passages on an endless track: the example, against the same strike on an ordinary track."""

from pathlib import Path

import numpy as np
import pytest

from railcosim.passage import run_passage
from railcosim.scenario_file import read_scenario
from railcosim.summary import summarise

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "endless_track.toml"
STATIC_LOAD = 117_720.0
ONCE = ("flat.periodic=false", "run.departure=1.5")


@pytest.fixture(scope="module")
def strikes(tmp_path_factory):
    """The example with one strike, 46 bays from the start, and the same on an ordinary track."""
    folder = tmp_path_factory.mktemp("fmus")
    near = ("track.endless=false", "flat.position=16.6", "run.approach=10.0")
    return [
        run_passage(
            read_scenario(EXAMPLE, (*ONCE, *changes)),
            fmus="native",
            contact="track",
            directory=folder,
        )
        for changes in ((), near)
    ]


def test_the_strike_is_that_on_an_ordinary_track(strikes):
    """What differs are waves of 1 kHz between the ends of fifty bays."""
    endless, ordinary = (summarise(strike) for strike in strikes)
    assert endless.peak_contact_force == pytest.approx(160.2e3, abs=0.1e3)
    assert endless.peak_contact_force == pytest.approx(
        ordinary.peak_contact_force, abs=1e-3 * STATIC_LOAD
    )
    assert endless.max_sleeper_displacement == pytest.approx(
        ordinary.max_sleeper_displacement, rel=1e-4
    )
    assert endless.peak_bending_moment_midspan == pytest.approx(
        ordinary.peak_bending_moment_midspan, rel=1e-3
    )


def test_forces_agree_all_the_way(strikes):
    distance = np.linspace(-3.0, 1.4, 4401)
    ours, theirs = (
        np.interp(distance, strike["distance"], strike["contact_force"].sel(wheel=1))
        for strike in strikes
    )
    assert ours == pytest.approx(theirs, abs=5e-3 * STATIC_LOAD)


def test_sleepers_keep_their_place_while_the_window_moves(strikes):
    """Every sleeper of the result is the one at its position, from before the window holds it."""
    endless, ordinary = strikes
    moved = endless["sleeper_position"] - ordinary["sleeper_position"]
    assert moved.to_numpy() == pytest.approx(100.45 - 16.6, abs=1e-9)
    # passed one after the other by the leading wheel, and level long before
    pressed = endless["sleeper_displacement"].to_numpy()
    near = np.abs(endless["sleeper_position"].to_numpy() - 95.0) < 3.0
    assert np.all(pressed[:, near].max(axis=0) > 3.5e-4)
    assert np.all(np.abs(pressed[0, near]) < 1e-6)
    leading = endless["wheel_position"].sel(wheel=1).to_numpy()
    deepest = leading[pressed[:, near].argmax(axis=0)]
    behind = deepest - endless["sleeper_position"].to_numpy()[near]
    assert np.all((behind > -0.3) & (behind < 2.1))  # below one of the wheels, 1.8 m apart


@pytest.mark.slow
def test_the_contact_of_the_vehicle_runs_over_the_seam_too(tmp_path):
    """With steps that are repeated and rejected: the strike is the same."""
    changes = (*ONCE, "run.approach=8.0")
    result = run_passage(read_scenario(EXAMPLE, changes), fmus="native", directory=tmp_path)
    assert summarise(result).peak_contact_force == pytest.approx(160.2e3, abs=4e-3 * STATIC_LOAD)
