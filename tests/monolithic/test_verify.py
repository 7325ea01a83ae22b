"""`railcosim verify`: what it finds, says and ends with."""

import json

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

from railcosim import cli
from railcosim.builds import usual_build
from railcosim.monolithic import solve
from railcosim.passage import run_passage
from railcosim.scenario_file import read_scenario
from railcosim.verification import agreements

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
