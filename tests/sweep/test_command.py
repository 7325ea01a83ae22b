"""`railcosim sweep`: what it prints, writes and ends with."""

import json

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

from railcosim import cli
from railcosim.sweep import cluster, running

SPEEDS = "[sweep.grid]\nvehicle.speed_kmh = [60, 80]\n"
ONE_FAILS = "master.min_step = 2e-5\n[sweep.grid]\nmaster.tolerance = [2e-3, 1e-9]\n"


@pytest.fixture
def call(cheap, client, tmp_path, monkeypatch):
    """Run the command line on a study, with the worker in this process."""
    real = running.run_study

    def run_study(study, *, workers, scheduler, **options):
        given = client if workers is None and scheduler is None else None
        return real(study, client=given, workers=workers, scheduler=scheduler, **options)

    monkeypatch.setattr("railcosim.commands.sweep.run_study", run_study)
    path = tmp_path / "study.toml"

    def call(text, *options):
        path.write_text(cheap + text)
        return CliRunner().invoke(cli.app, ["sweep", str(path), *map(str, options)])

    return call


def test_a_sweep_writes_its_result_and_its_store_beside_the_study(call, tmp_path):
    answer = call(SPEEDS, "--json")
    assert (answer.exit_code, answer.stderr) == (0, "")
    output = tmp_path / "study.nc"
    assert json.loads(answer.stdout) == {
        "cases": 2,
        "stored_before": 0,
        "run": 2,
        "failed": [],
        "output": str(output),
    }
    with xr.open_dataset(output, engine="h5netcdf") as result:
        assert result["vehicle.speed_kmh"].to_numpy().tolist() == [60.0, 80.0]
    assert len([*(tmp_path / "study.store").glob("*.json")]) == 3  # with the store's mark
    again = call(SPEEDS)
    assert again.exit_code == 0
    assert "run now │ 0" in " ".join(again.stdout.split())


def test_failures_end_with_1_after_the_result_is_written(call, tmp_path):
    answer = call(ONE_FAILS, "--json", "--output", tmp_path / "r.nc", "--store", tmp_path / "s")
    assert answer.exit_code == 1
    (line,) = answer.stderr.splitlines()
    assert line.startswith("railcosim: 1 of 2 cases failed, the first (master.tolerance = 1e-09)")
    (failed,) = json.loads(answer.stdout)["failed"]
    assert failed["case"] == {"master.tolerance": 1e-9}
    assert failed["reason"].rstrip(".") in line
    with xr.open_dataset(tmp_path / "r.nc", engine="h5netcdf") as result:
        assert result["failure"].to_numpy().tolist() == ["", failed["reason"]]
        assert np.isnan(result["peak_contact_force"].to_numpy()).tolist() == [False, True]


def test_without_dask_the_extra_is_named(call, tmp_path, monkeypatch):
    monkeypatch.setattr(cluster, "find_spec", lambda _: None)
    answer = call(SPEEDS, "--workers", 1)
    assert answer.exit_code == 2
    assert "pip install 'railcosim[sweep]'" in answer.stderr
    assert not (tmp_path / "study.nc").exists()


@pytest.mark.parametrize(
    ("options", "part"),
    [
        (["--workers", "0"], "--workers is 0 but must be at least 1"),
        (["--scheduler", "tcp://127.0.0.1:1"], "--scheduler tcp://127.0.0.1:1 does not answer"),
        (["--scheduler", "gopher://x"], "--scheduler gopher://x does not answer"),
        (["--output", "study.csv"], "--output study.csv ends with '.csv'"),
        (["--output", "missing/study.nc"], "does not exist"),
    ],
)
def test_wrong_options_end_with_2(call, monkeypatch, options, part):
    monkeypatch.setattr(cluster, "PATIENCE", 1)
    answer = call(SPEEDS, *options)
    assert (answer.exit_code, answer.stdout) == (2, "")
    assert part in answer.stderr


def test_a_wrong_study_ends_with_2_and_leaves_nothing(call, tmp_path):
    answer = call("[sweep.grid]\nvehicle.speed_kmh = [60, 0.01]\n")
    assert answer.exit_code == 2
    assert "case 2 (vehicle.speed_kmh = 0.01)" in answer.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["study.toml"]
