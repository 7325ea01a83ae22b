import json

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

from railcosim import cli
from railcosim.figures.receptance import draw_receptance
from railcosim.receptance.dataset import compute_receptance, frequency_range
from railcosim.receptance.measured import MeasuredReceptance
from railcosim.receptance.points import Place
from railcosim.receptance.study import ReceptanceStudy
from railcosim.scenario import Scenario

FEW = ("--points", "60", "--to", "400")


@pytest.fixture
def call(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def call(*arguments):
        return CliRunner().invoke(cli.app, ["receptance", *map(str, arguments)])

    return call


@pytest.fixture
def measured(tmp_path):
    """The receptance of Table 1 itself, 10 % too large and 5 degrees late."""
    study = ReceptanceStudy(
        scenario=Scenario(), load=Place(position=16.575), response=Place(position=16.575)
    )
    frequency = np.geomspace(20.0, 300.0, 12)
    value = study.receptance(frequency)
    rows = zip(frequency, 1.1 * np.abs(value), np.rad2deg(np.angle(value)) - 5.0, strict=True)
    path = tmp_path / "hammer.csv"
    path.write_text("\n".join(f"{f!r},{a!r},{p!r}" for f, a, p in np.array([*rows]).tolist()))
    return path


def test_a_table_names_the_resonances(call):
    result = call(*FEW)
    assert (result.exit_code, result.stderr) == (0, "")
    for part in ("rail at 16.575 m", "16.837", "63.1 Hz", "257.1 Hz", "modal from direct"):
        assert part in result.stdout


def test_json_and_files(call, measured, tmp_path):
    result = call(
        *("--json", "--measured", measured, *FEW),
        *("--output", "r.nc", "--plot", "r.svg"),
    )
    assert (result.exit_code, result.stderr) == (0, "")
    numbers = json.loads(result.stdout)
    assert numbers["static_flexibility"] == pytest.approx(16.84e-9, abs=0.005e-9)
    assert [peak["frequency"] for peak in numbers["peaks"]] == pytest.approx([63.1, 257.1], abs=0.1)
    # 20 lg 1.1 dB and 5 degrees at every frequency
    assert numbers["measured"]["amplitude"] == pytest.approx(20 * np.log10(1.1), rel=1e-9)
    assert numbers["measured"]["phase"] == pytest.approx(5.0, rel=1e-9)
    with xr.open_dataset(tmp_path / "r.nc", engine="h5netcdf") as stored:
        assert stored["amplitude"].dims == ("frequency", "solution")
        assert "pad_stiffness = 80000000.0" in stored.attrs["scenario"]
    assert (tmp_path / "r.svg").stat().st_size > 10_000


def test_csv_has_a_row_for_each_frequency(call, tmp_path):
    assert call("--method", "direct", "--output", "r.csv", *FEW).exit_code == 0
    header, *rows = (tmp_path / "r.csv").read_text().splitlines()
    assert header == "frequency [Hz],amplitude[direct] [m/N],phase[direct] [degree]"
    assert len(rows) == 60


def test_a_transfer_receptance_under_a_preload(call):
    result = call(
        *("--json", "--position", "16.25", "--response", "sleeper:25"),
        *("--preload", "117720", "--method", "modal", *FEW),
    )
    numbers = json.loads(result.stdout)
    assert (numbers["load"], numbers["response"]) == ("rail at 16.25 m", "sleeper 25")
    assert (numbers["preload"], numbers["methods"]) == (117720.0, ["modal"])
    assert numbers["modal_deviation"] is None


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        (["--position", "40"], "not between the clamped ends"),
        (["--response", "there"], "--response there is no place"),
        (["--preload", "-5"], "-5 N but must be from 0 to 1e+07 N"),
        (["--preload", "5", "--set", "track.ballast=linear"], "linear track"),
        (["--from", "100", "--to", "50"], "no range"),
        (["--points", "1"], "choose 3 to"),
        (["--output", "r.txt"], "--output r.txt"),
        (["--plot", "r.txt"], "--plot r.txt"),
        (["--measured", "missing.csv"], "missing.csv: cannot be read"),
        (["--set", "track.pads=1"], "track.pads is no key"),
        (["missing.toml"], "No such file"),
    ],
)
def test_wrong_input_ends_with_2_and_one_sentence(call, tmp_path, arguments, part):
    result = call(*arguments)
    assert (result.exit_code, result.stdout, [*tmp_path.iterdir()]) == (2, "", [])
    (line,) = result.stderr.splitlines()
    assert part in line


@pytest.mark.parametrize("method", ["direct", "modal"])
def test_parameters_beyond_all_bounds_end_with_1_and_one_sentence(call, method):
    result = call("--method", method, "--set", "track.pad_stiffness=1e308", *FEW)
    assert (result.exit_code, result.stdout) == (1, "")
    (line,) = result.stderr.splitlines()
    assert "[track]" in line


def test_the_smallest_track_has_a_receptance(call):
    """Two elements, three degrees of freedom, fewer than the band is wide."""
    size = ("track.bays=2", "track.elements_per_bay=1", "flat.position=0.6")
    run = ("run.approach=0.3", "run.departure=0.2", "vehicle.axle_base=0.1")
    sets = [word for key in (*size, *run) for word in ("--set", key)]
    result = call("--json", *sets, *FEW)
    assert (result.exit_code, result.stderr) == (0, "")
    assert json.loads(result.stdout)["modal_deviation"]["largest"] < 1e-9


def test_the_figure_shows_curves_resonances_and_measured_points():
    place = Place(position=16.575)
    study = ReceptanceStudy(scenario=Scenario(), load=place, response=place)
    curves = compute_receptance(study, frequency_range(20.0, 400.0, 40))
    measured = MeasuredReceptance(
        frequency=np.array([30.0, 60.0]),
        amplitude=np.array([2e-8, 3e-8]),
        phase=np.array([350.0, -40.0]),
    )
    amplitude, phase = draw_receptance(curves, measured).axes
    drawn = {line.get_label(): line for line in amplitude.lines}
    assert drawn["direct"].get_ydata() == pytest.approx(curves["amplitude"].to_numpy()[:, 0])
    assert drawn["measured"].get_ydata().tolist() == [2e-8, 3e-8]
    dots = [line for line in phase.lines if line.get_marker() == "."]
    assert dots[0].get_ydata() == pytest.approx([-10.0, -40.0])
    assert [text.get_text() for text in amplitude.texts] == ["63 Hz", "257 Hz"]
