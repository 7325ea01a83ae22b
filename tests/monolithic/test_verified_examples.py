"""Suspended vehicles, uneven surfaces and endless tracks: co-simulation and monolith agree."""

import json
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from railcosim import cli
from railcosim.builds import usual_build
from railcosim.monolithic import solve
from railcosim.passage import run_passage
from railcosim.scenario_file import read_scenario
from railcosim.suspension_section import Suspension
from railcosim.verification import agreements

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
SHORT = ("run.approach=0.1", "run.departure=0.1")
FEWER = "track.mode_pairs=150"
"""Of both solutions: dense matrices of 400 pairs take long."""
SHORTER = {
    "coach": SHORT,
    "uneven_rail": ("surface.ramp=0.1", "flat.position=16.9", "run.approach=0.2", *SHORT[1:]),
    "worn_wheels": (FEWER, "run.approach=0.2", *SHORT[1:]),
    "endless_track": SHORT,
    "endless_supports": SHORT,
    "moving_ballast": SHORT,
}
FULL = {"moving_ballast"}
"""Those that only the full model holds."""
WHOLE = {
    "coach": (),
    "uneven_rail": (),
    "worn_wheels": (FEWER,),
    "moving_ballast": (),
    "endless_supports": ("run.approach=0.6", "run.departure=0.6"),
    # over two moves of the window; all of it takes an hour
    "endless_track": ("run.approach=8", "run.departure=3"),
}
"""What is set of the examples in one of their pieces, and in all of it."""

EVERYTHING = """
[vehicle]
speed_table = "speed.csv"
model = "suspended"
wheels = 6
bogies = 2
bogie_distance = 6.0

[suspension]
tread_mass = 250
tread_stiffness = 6e8
tread_damping = 3e3
car_mass = 20000
primary_clearance = 1e-5
primary_stop_stiffness = 1e7
primary_rebound_ratio = 4
secondary_clearance = -1e-3
secondary_stop_stiffness = 1e6
secondary_rebound_ratio = 0.5

[flat]
wheel = 5
periodic = true
shape = "cusp"
depth = 0.5e-3

[surface]
ramp = 0.2
contact_filter = true

[run]
approach = 0.3
departure = 0.3

[[irregularity]]
kind = "german"
disturbance = "high"

[[irregularity]]
kind = "corrugation"
wavelength = 0.08

[[wheel_defect]]
kind = "spall"
wheel = 6
angle_deg = 100

[[wheel_defect]]
kind = "polygon"
order = 11
wheel = 2
level_db = 30
"""
"""Speeds that change, bump stops that are met, one-sided dampers, flexible wheelsets, uneven
surfaces; 0.09 % of the static load, and 0.06 % of the change of the suspension forces."""


def call(*arguments):
    return CliRunner().invoke(cli.app, ["verify", *map(str, arguments)])


@pytest.mark.parametrize("example", SHORTER)
def test_a_short_piece_of_every_other_kind_of_passage_agrees(example):
    scenario = read_scenario(EXAMPLES / f"{example}.toml", SHORTER[example])
    passage = run_passage(scenario, fmus=usual_build("vehicle"))
    model = "full" if example in FULL else "modal"
    monolith = solve(scenario, model=model, times=passage["time"].to_numpy())
    found = agreements(passage, monolith)
    assert [item.describe() for item in found if not item.holds] == []
    suspended = {"primary suspension", "secondary suspension"}
    assert suspended <= {item.quantity for item in found} or example != "coach"


def test_three_axles_of_a_bogie_stand_alike_on_an_uneven_rail(tmp_path):
    """Loads that the heights leave, and velocities of all bodies, from two solutions for both."""
    rail = tmp_path / "rail.csv"
    rail.write_text("position,drop\n13,2e-3\n14,-1e-3\n15,1e-3\n16,0\n17,1e-3\n", encoding="utf-8")
    keys = (
        *SHORT,
        f"vehicle.rail_irregularity={rail}",
        "vehicle.model=suspended",
        "vehicle.wheels=3",
        "vehicle.axle_base=1.2",
        "suspension.primary_clearance=1e-4",
        "suspension.primary_stop_stiffness=5e6",
    )
    scenario = read_scenario(None, keys)
    passage = run_passage(scenario, fmus=usual_build("vehicle"))
    monolith = solve(scenario, times=passage["time"].to_numpy())
    load = float(passage["static_wheel_load"])
    for name, scale in (
        ("contact_force", load),
        ("primary_force", load),
        ("wheel_velocity", 0.1),
        ("bogie_displacement", 1e-3),
        ("bogie_pitch", 1e-3),
    ):
        ours, theirs = passage[name][0].to_numpy(), monolith[name][0].to_numpy()
        # the modes that are left out do not follow the velocity of the track
        assert ours == pytest.approx(theirs, abs=2e-4 * scale), name
    assert np.ptp(monolith["contact_force"][0].to_numpy()) > 0.005 * load
    assert [item.describe() for item in agreements(passage, monolith) if not item.holds] == []


def test_springs_that_differ_are_found():
    """Two per cent more stiffness in one of both solutions is seen in the suspension's forces."""
    stiffness = Suspension().primary_stiffness
    keys = (*SHORT, "vehicle.model=suspended", "suspension.primary_damping=0")
    passage = run_passage(read_scenario(None, keys), fmus=usual_build("vehicle"))
    stiffer = read_scenario(None, (*keys, f"suspension.primary_stiffness={1.02 * stiffness}"))
    monolith = solve(stiffer, times=passage["time"].to_numpy())
    found = {item.quantity: item for item in agreements(passage, monolith)}
    assert found["contact force of wheel 1"].holds
    assert abs(found["primary suspension"].difference) == pytest.approx(0.02, abs=5e-3)
    assert not found["primary suspension"].holds


@pytest.mark.slow
@pytest.mark.parametrize("example", WHOLE)
def test_whole_examples_agree(example):
    settings = [word for override in WHOLE[example] for word in ("--set", override)]
    settings += ["--model", "full" if example in FULL else "modal"]
    result = call(EXAMPLES / f"{example}.toml", "--fmus", "native", "--json", *settings)
    assert result.exit_code == 0, result.stderr
    assert json.loads(result.stdout)["holds"] is True


@pytest.mark.slow
def test_everything_at_once_agrees(tmp_path):
    (tmp_path / "speed.csv").write_text("time,speed\n0,20\n0.01,25\n0.03,15\n", encoding="utf-8")
    (tmp_path / "everything.toml").write_text(EVERYTHING, encoding="utf-8")
    result = call(tmp_path / "everything.toml", "--fmus", "native", "--json")
    assert result.exit_code == 0, result.stderr
    found = json.loads(result.stdout)["agreements"]
    # six wheels, both suspensions, the peak
    assert len(found) == 9
    assert max(abs(item["difference"]) for item in found) < 2e-3
