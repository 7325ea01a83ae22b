import json

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

from railcosim import cli
from railcosim.errors import RunError

SPEEDS = np.array([30.0, 35.0, 40.0])
FORCE = np.array([[2.3e5, 1.5e5], [2.4e5, 1.7e5], [2.35e5, 1.8e5]])
FIGURES = (
    "figure_6_receptance",
    "figure_7_load_displacement",
    "figure_9_peak_contact_force",
    "figure_10_peak_bending_moment",
    "histories_40_kmh",
)


@pytest.fixture
def call(monkeypatch, make_passage):
    """Run the command with passages made by hand."""
    dims = ("vehicle.speed_kmh", "track.ballast")
    result = xr.Dataset(
        {
            "peak_contact_force": (dims, FORCE),
            "peak_bending_moment_midspan": (dims, 0.15 * FORCE),
            "max_sleeper_displacement": (dims, 1e-8 * FORCE),
            "failure": (dims, np.full(FORCE.shape, "")),
        },
        {"vehicle.speed_kmh": SPEEDS, "track.ballast": ["state_dependent", "linear"]},
    )
    seen = {}

    def run_study(study, **options):
        seen["study"], seen["options"] = study, options
        return result

    def full_passages(scenario, speed_kmh, **_):
        assert speed_kmh == 40.0
        distance = np.linspace(-1.0, 1.5, 26)
        return {name: make_passage(distance, scenario) for name in ("state_dependent", "linear")}

    monkeypatch.setattr("railcosim.commands.figures.run_study", run_study)
    monkeypatch.setattr("railcosim.commands.figures.full_passages", full_passages)
    monkeypatch.setattr("railcosim.commands.figures.RECEPTANCE", (10.0, 200.0, 60))

    def call(*arguments):
        texts = ["figures", *map(str, arguments)]
        return CliRunner().invoke(cli.app, texts)

    call.seen = seen
    return call


def test_all_is_written_told_and_described(call, tmp_path):
    folder = tmp_path / "new" / "figures"
    flat = ("--set", "flat.shape=parabola", "--set", "flat.depth=1e-3")
    result = call(folder, "--speeds", "30:40:5", "--json", *flat)
    assert result.exit_code == 0
    names = {path.name for path in folder.iterdir()}
    drawn = {f"{name}{kind}" for name in FIGURES for kind in (".pdf", ".png")}
    assert names == drawn | {"captions.md", "peaks.nc"}
    assert (folder / f"{FIGURES[1]}.pdf").read_bytes().startswith(b"%PDF")
    assert len(call.seen["study"]) == 6
    assert call.seen["options"]["store"] == folder / "passages"

    answer = json.loads(result.stdout)
    assert [item["files"][1] for item in answer["figures"]] == [
        str(folder / f"{name}.png") for name in FIGURES
    ]
    assert answer["speed_kmh"] == SPEEDS.tolist()
    assert answer["state_dependent"]["peak_contact_force"] == FORCE[:, 0].tolist()
    assert answer["state_dependent"]["speed_kmh_of_largest_force"] == 35.0
    assert answer["linear"]["speed_kmh_of_largest_force"] == 40.0

    text = (folder / "captions.md").read_text(encoding="utf-8")
    for name in FIGURES:
        assert f"![{name}]({name}.png)" in text
    assert text.count("parabola 100 mm x 1 mm flat on wheel 1") == 3
    assert text.count("592.5 kg") == 3
    assert text.count("No measured points are drawn") == 5
    assert "largest at 35 km/h on the state-dependent track and at 40 km/h on the linear" in text
    assert "resonances at 63 Hz" in text
    assert answer["resonance_frequencies"] == pytest.approx([63.1], abs=0.1)


def test_measured_points_are_named_where_they_are_drawn(call, tmp_path, monkeypatch):
    peaks, receptance = tmp_path / "campaign.csv", tmp_path / "hammer.csv"
    peaks.write_text("40,2.3e5\n")
    receptance.write_text("50,1e-8,-30\n60,2e-8,-90\n")
    ballast = tmp_path / "ballast.csv"
    ballast.write_text("1e4,5e7\n2e4,7e7\n3e4,9e7\n")
    monkeypatch.setattr("railcosim.commands.figures.KINDS", (".pdf",))
    given = ("--measured", peaks, "--measured-receptance", receptance)
    given += ("--measured-ballast", ballast)
    assert call(tmp_path / "out", *given).exit_code == 0
    text = (tmp_path / "out" / "captions.md").read_text(encoding="utf-8")
    assert text.count("Measured points: measured (campaign).") == 1  # it holds no moments
    assert text.count("Measured points: the user's.") == 2
    assert text.count("No measured points are drawn") == 2


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--speeds", "5:100"), "--speeds is '5:100' but must be FROM:TO:STEP"),
        (("--speeds", "0:10:5"), "vehicle.speed_kmh is 0 km/h"),
        (("--workers", "0"), "--workers is 0"),
        (("--measured", "missing.csv"), "missing.csv"),
        (("--set", "flat.shape=square"), "flat.shape is 'square'"),
    ],
)
def test_wrong_input_is_found_before_anything_runs(call, tmp_path, options, message):
    result = call(tmp_path / "out", *options)
    assert result.exit_code == 2
    assert message in result.stderr
    assert call.seen == {}
    assert not (tmp_path / "out").exists()


def test_a_folder_that_cannot_be_made_is_refused(call, tmp_path):
    (tmp_path / "file").write_text("")
    result = call(tmp_path / "file" / "out")
    assert result.exit_code == 2
    assert "name another" in result.stderr
    assert call.seen == {}


def test_a_passage_that_fails_ends_the_command(call, tmp_path, monkeypatch):
    def run_study(*_, **__):
        raise RunError("the disk is full")

    monkeypatch.setattr("railcosim.commands.figures.run_study", run_study)
    result = call(tmp_path, "--quiet")
    assert result.exit_code == 1
    assert result.stderr == "railcosim: the disk is full\n"
