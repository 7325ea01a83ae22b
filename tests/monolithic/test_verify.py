"""`railcosim verify`: what it finds, says and ends with."""

import json
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
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
FIVE = {
    "the paper's case": (),
    "80 km/h, cusp": ("vehicle.speed_kmh=80", "flat.shape=cusp"),
    "35 km/h, linear track": ("vehicle.speed_kmh=35", "track.ballast=linear"),
    "100 km/h, one wheel that leaves the rail": (
        "vehicle.speed_kmh=100",
        "vehicle.wheels=1",
        "flat.depth=2e-3",
    ),
    "60 km/h, four round wheels": (
        "vehicle.speed_kmh=60",
        "vehicle.wheels=4",
        "flat.shape=none",
    ),
}


SHORTER = {
    "coach": SHORT,
    "uneven_rail": ("surface.ramp=0.1", "flat.position=16.9", "run.approach=0.2", *SHORT[1:]),
    "worn_wheels": ("run.approach=0.2", *SHORT[1:]),
    "endless_track": SHORT,
}
WHOLE = {
    "coach": (),
    "uneven_rail": (),
    "worn_wheels": (),
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


@pytest.fixture(scope="module")
def monolith():
    return solve(read_scenario(None, SHORT), times=np.linspace(0.0, 0.018, 361))


def call(*arguments):
    return CliRunner().invoke(cli.app, ["verify", *map(str, arguments)])


@pytest.fixture
def given(monkeypatch, monolith):
    """Let both solutions be the monolith's, the co-simulated force being changed."""

    def given(change):
        passage = monolith.copy(deep=True)
        passage["contact_force"] = passage["contact_force"] + change(passage)
        monkeypatch.setattr("railcosim.commands.verify.run_passage", lambda *_, **__: passage)
        monkeypatch.setattr("railcosim.monolithic.solve", lambda *_, **__: monolith)

    return given


def spike(passage):
    """1.5 kN on wheel 2 at 15 ms."""
    here = (np.abs(passage["time"] - 0.015) < 1e-9) & (passage["wheel"] == 2)
    return 1500.0 * here


def test_what_agrees_ends_with_0(given, tmp_path):
    given(lambda _: 0.0)
    files = tmp_path / "both.nc", tmp_path / "both.png"
    result = call("--json", "--output", files[0], "--plot", files[1])
    assert (result.exit_code, result.stderr) == (0, "")
    numbers = json.loads(result.stdout)
    assert numbers["holds"] is True
    assert [item["difference"] for item in numbers["agreements"]] == [0.0, 0.0, 0.0]
    with xr.open_dataset(files[0], engine="h5netcdf") as both:
        assert float(np.abs(both["difference"]).max()) == 0.0
    assert files[1].read_bytes().startswith(b"\x89PNG")


def test_what_differs_is_named_with_place_and_remedy(given):
    given(spike)
    result = call()
    assert result.exit_code == 1
    (line,) = result.stderr.splitlines()
    assert "contact force of wheel 2: +1.274 % of the static load" in line
    assert "t = 0.015000 s" in line
    assert "master.step=2e-05" in line
    assert "FAILS" in result.stdout


def test_a_peak_that_differs_is_found(given):
    given(lambda passage: 0.004 * passage["contact_force"])
    found = json.loads(call("--json").stdout)["agreements"]
    assert found[-1]["difference"] == pytest.approx(0.004, rel=1e-6)
    assert [item["holds"] for item in found] == [True, True, False]


def test_a_short_passage_agrees():
    scenario = read_scenario(None, SHORT)
    passage = run_passage(scenario, fmus=usual_build("vehicle"))
    monolith = solve(scenario, times=passage["time"].to_numpy())
    assert [item.describe() for item in agreements(passage, monolith) if not item.holds] == []


@pytest.mark.parametrize("example", SHORTER)
def test_a_short_piece_of_every_other_kind_of_passage_agrees(example):
    scenario = read_scenario(EXAMPLES / f"{example}.toml", SHORTER[example])
    passage = run_passage(scenario, fmus=usual_build("vehicle"))
    monolith = solve(scenario, times=passage["time"].to_numpy())
    found = agreements(passage, monolith)
    assert [item.describe() for item in found if not item.holds] == []
    suspended = {"primary suspension", "secondary suspension"}
    assert suspended <= {item.quantity for item in found} or example != "coach"


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


@pytest.mark.slow
@pytest.mark.parametrize("overrides", FIVE.values(), ids=FIVE)
def test_whole_passages_agree(overrides):
    settings = [word for override in overrides for word in ("--set", override)]
    result = call("--fmus", "native", "--json", *settings)
    assert result.exit_code == 0, result.stderr
    assert json.loads(result.stdout)["holds"] is True


@pytest.mark.slow
def test_the_paper_s_case_agrees_with_the_full_track():
    assert call("--fmus", "native", "--model", "full").exit_code == 0
