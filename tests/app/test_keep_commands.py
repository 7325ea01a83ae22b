"""Commands with a scenario that keeps some histories."""

import json

import pytest
import xarray as xr
from typer.testing import CliRunner

from railcosim import cli
from railcosim.errors import RunError

KEEPS = ("--set", "keep.signals=['contact_force']", "--set", "keep.spacing=0.05")


@pytest.fixture
def call():
    def call(*arguments):
        return CliRunner().invoke(cli.app, [str(argument) for argument in arguments])

    return call


@pytest.mark.parametrize(
    ("command", "name"),
    [
        (("run", "--plot", "x.png"), "--plot"),
        (("verify",), "railcosim verify"),
        (("report",), "railcosim report"),
    ],
)
def test_what_needs_every_history_says_so_before_the_run(
    call, monkeypatch, tmp_path, command, name
):
    monkeypatch.chdir(tmp_path)
    result = call(*command, *KEEPS)
    assert result.exit_code == 2
    assert result.stderr == (
        f"railcosim: {name} needs every history at every step but the scenario keeps contact_force "
        "every 0.05 m: take its [keep] out\n"
    )
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("suffix", [".nc", ".csv"])
def test_the_file_appears_alone(call, tmp_path, suffix):
    """Written on the way or at the end, with the numbers of every step on the terminal."""
    output = tmp_path / f"kept{suffix}"
    near = ("--set", "run.approach=0.15", "--set", "run.departure=0.1")
    result = call("run", *KEEPS, *near, "--fmus", "native", "--output", output, "--json")
    assert result.exit_code == 0, result.stderr
    assert list(tmp_path.iterdir()) == [output]
    run = json.loads(result.stdout)["whole_run"]
    if suffix == ".csv":
        assert len(output.read_text().splitlines()) == 1 + 6
        return
    with xr.open_dataset(output, engine="h5netcdf", decode_times=False) as kept:
        assert kept["distance"].to_numpy() == pytest.approx([-0.15, -0.1, -0.05, 0, 0.05, 0.1])
        assert float(kept["contact_force_largest"].max()) == run["largest_contact_force"]


@pytest.mark.parametrize("is_kept", [True, False])
def test_a_run_that_fails_leaves_its_part_or_nothing(call, monkeypatch, tmp_path, is_kept):
    def run_passage(*_, histories, **__):
        histories.write_text("a part")
        raise RunError("it failed", result=xr.Dataset() if is_kept else None)

    monkeypatch.setattr("railcosim.commands.run.run_passage", run_passage)
    output = tmp_path / "kept.nc"
    result = call("run", *KEEPS, "--output", output, "--quiet")
    assert (result.exit_code, result.stderr) == (1, "railcosim: it failed\n")
    assert list(tmp_path.iterdir()) == ([output] if is_kept else [])
