import json

import numpy as np
import pytest
from typer.testing import CliRunner

from railcosim import cli
from railcosim.load_displacement import SecantLaw, equidistant_loads
from railcosim.scenario_file import read_scenario

from .synthetic import TRUE, noisy

WRONG = [
    word
    for name, value in TRUE.items()
    for word in ("--set", f"track.{name}={(0.6 if 'pad' in name else 1.7) * value:g}")
]


@pytest.fixture
def call(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def call(*arguments):
        return CliRunner().invoke(cli.app, [str(argument) for argument in arguments])

    return call


@pytest.fixture
def hammer(tmp_path):
    data = noisy(np.geomspace(20.0, 1500.0, 80), noise=0.03, seed=4)
    table = np.stack([data.frequency, data.amplitude, data.phase], axis=1)
    path = tmp_path / "hammer.csv"
    np.savetxt(path, table, delimiter=",", header="frequency,amplitude,phase", comments="")
    return path


@pytest.fixture
def secant(tmp_path):
    force = equidistant_loads()
    path = tmp_path / "secant.csv"
    law = SecantLaw()
    np.savetxt(path, np.stack([force, law.slope * force + law.stiffness], axis=1), delimiter=",")
    return path


def test_a_track_is_tuned_and_its_file_is_a_scenario(call, hammer, tmp_path):
    result = call(
        *("tune", "receptance", hammer, *WRONG, "--set", "track.sleeper_spacing=0.65"),
        *("--output", "tuned.toml", "--plot", "fit.png", "--json"),
    )
    assert (result.exit_code, result.stderr) == (0, "")
    numbers = json.loads(result.stdout)
    track = read_scenario(tmp_path / "tuned.toml").track
    for name, value in TRUE.items():
        item = numbers["parameters"][name]
        assert item["value"] == pytest.approx(value, rel=0.03)
        assert item["low"] < item["value"] < item["high"]
        assert item["start"] != item["value"] == getattr(track, name)
    assert numbers["points"] == 80
    assert numbers["amplitude_deviation"] == pytest.approx(0.03 * 8.686, rel=0.25)
    assert numbers["phase_deviation"] == pytest.approx(np.rad2deg(0.03), rel=0.25)
    text = (tmp_path / "tuned.toml").read_text()
    assert text.count("=") == 4  # the spacing is the default
    assert "hammer.csv" in text.splitlines()[0]
    assert (tmp_path / "fit.png").stat().st_size > 10_000


def test_what_one_command_writes_the_other_reads(call, tmp_path):
    """Without noise the interval shrinks to the truth."""
    known = ("--method", "direct", "--from", "20", "--to", "1500", "--points", "40")
    assert call("receptance", *known, "--output", "known.csv").exit_code == 0
    result = call("tune", "receptance", "known.csv", *WRONG, "--output", "tuned.toml")
    assert result.exit_code == 0
    track = read_scenario(tmp_path / "tuned.toml").track
    for name, value in TRUE.items():
        assert getattr(track, name) == pytest.approx(value, rel=1e-6)


def test_other_keys_that_the_fit_relied_on_are_kept(call, hammer, tmp_path):
    result = call(
        *("tune", "receptance", hammer, "--set", "track.sleeper_mass=120"),
        *("--hold", "pad_damping", "--from", "30", "--to", "800", "--output", "tuned.toml"),
    )
    assert result.exit_code == 0
    assert "pad_damping" not in result.stdout
    track = read_scenario(tmp_path / "tuned.toml").track
    assert (track.sleeper_mass, track.pad_damping) == (120.0, TRUE["pad_damping"])


def test_the_table_shows_start_and_interval(call, hammer):
    result = call("tune", "receptance", hammer, *WRONG)
    assert (result.exit_code, result.stderr) == (0, "")
    for part in ("hammer.csv", "pad_stiffness", " 48 ", "MN/m", "amplitude, r.m.s.", "dB"):
        assert part in result.stdout


def test_ballast_is_tuned_and_its_file_is_a_scenario(call, secant, tmp_path):
    result = call(
        *("tune", "ballast", secant, "--output", "tuned.toml", "--plot", "fit.svg", "--json"),
        *("--fit-stiffness",),
    )
    assert (result.exit_code, result.stderr) == (0, "")
    numbers = json.loads(result.stdout)
    track = read_scenario(tmp_path / "tuned.toml").track
    assert track.ballast_alpha == numbers["parameters"]["ballast_alpha"]["value"]
    assert track.ballast_alpha == pytest.approx(0.37e12, abs=0.005e12)
    assert numbers["slope"]["value"] == pytest.approx(2e3, rel=1e-9)
    assert numbers["stiffness"] == pytest.approx(30e6, rel=1e-9)
    assert track.ballast_stiffness == 30e6
    assert (tmp_path / "fit.svg").stat().st_size > 10_000
    shown = call("tune", "ballast", secant)
    assert "slope of the line" in shown.stdout


def test_load_displacement_prints_and_writes(call, secant, tmp_path):
    result = call(
        *("load-displacement", "--measured", secant, "--output", "c.csv", "--plot", "c.pdf")
    )
    assert (result.exit_code, result.stderr) == (0, "")
    assert "0.390" in result.stdout
    header, *rows = (tmp_path / "c.csv").read_text().splitlines()
    assert header.startswith("displacement [m],force_law [N],force_polynomial [N]")
    assert len(rows) == 201
    numbers = json.loads(call("load-displacement", "--json", "--largest-load", "30e3").stdout)
    assert numbers["largest_displacement"] == pytest.approx(30e3 / 90e6, rel=1e-12)


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        (["tune", "receptance", "missing.csv"], "missing.csv: cannot be read"),
        (["tune", "receptance", "hammer.csv", "--to", "25"], "too few"),
        (["tune", "receptance", "hammer.csv", "--hold", "mass"], "--hold mass"),
        (["tune", "receptance", "hammer.csv", "--output", "t.nc"], "--output t.nc"),
        (["tune", "receptance", "hammer.csv", "--plot", "t.nc"], "--plot t.nc"),
        (["tune", "receptance", "hammer.csv", "--position", "33"], "33 m is not between"),
        (["tune", "ballast", "hammer.csv"], "line 2: has 3 values, not 2"),
        (["tune", "ballast", "missing.csv"], "missing.csv: cannot be read"),
        (["load-displacement", "--slope", "-1"], "from 0 to"),
        (["load-displacement", "--loads", "2"], "3 coefficients"),
        (["load-displacement", "--largest-load", "0"], "above 0 N"),
        (["load-displacement", "--frequency", "nan"], "--frequency is nan Hz"),
        (["load-displacement", "--measured", "missing.csv"], "missing.csv: cannot be read"),
    ],
)
def test_wrong_input_ends_with_2_and_one_sentence(call, hammer, tmp_path, arguments, part):
    result = call(*arguments)
    assert (result.exit_code, result.stdout, [*tmp_path.iterdir()]) == (2, "", [hammer])
    (line,) = result.stderr.splitlines()
    assert part in line


def test_a_failed_write_leaves_nothing(call, hammer, tmp_path, monkeypatch):
    def full(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.write_text", full)
    result = call("tune", "receptance", hammer, "--output", "tuned.toml")
    assert (result.exit_code, [*tmp_path.iterdir()]) == (1, [hammer])
    assert "No space left" in result.stderr
