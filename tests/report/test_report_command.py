import importlib.util
import json

import pytest
import xarray as xr
from typer.testing import CliRunner

from railcosim import cli
from railcosim.errors import RunError
from railcosim.output import write_dataset


@pytest.fixture
def call():
    def call(*arguments):
        return CliRunner().invoke(cli.app, ["report", *map(str, arguments)])

    return call


@pytest.fixture
def result(passage, tmp_path):
    path = tmp_path / "passage.nc"
    write_dataset(passage, path)
    return path


@pytest.fixture
def runs(monkeypatch):
    """Let every run end in one way, and tell which scenarios were run."""
    seen = []

    def runs(outcome):
        def run_passage(scenario, **_):
            seen.append(scenario)
            if isinstance(outcome, Exception):
                raise outcome
            return outcome

        monkeypatch.setattr("railcosim.commands.report.run_passage", run_passage)
        return seen

    return runs


def test_the_page_of_a_result_is_that_of_the_run(call, result, page, tmp_path):
    output = tmp_path / "report.html"
    answer = call(result, "--output", output)
    assert (answer.exit_code, answer.stderr) == (0, "")
    assert answer.stdout.startswith(f"{output} (")
    assert output.read_text(encoding="utf-8") == page


def test_a_scenario_is_run_and_its_numbers_printed(call, runs, passage, tmp_path):
    seen = runs(passage)
    scenario, output = tmp_path / "case.toml", tmp_path / "report.html"
    scenario.write_text("[flat]\ndepth = 2e-3\n")
    options = ("--set", "run.departure=1.05", "--json", "--quiet", "--convergence")
    answer = call(scenario, "--output", output, *options)
    assert answer.exit_code == 0
    numbers = json.loads(answer.stdout)
    assert numbers["bytes"] == output.stat().st_size
    assert numbers["summary"]["peak_contact_force"] > 3e5
    assert len(numbers["convergence"]["cases"]) == len(seen) == 6
    assert (seen[0].flat.depth, seen[0].run.departure) == (2e-3, 1.05)


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        (["--set", "flat.depht=1"], "flat.depth"),
        (["missing.toml"], "No such file"),
        (["missing.nc"], "there is no file missing.nc"),
        (["--output", "report.pdf"], "must end with one of .html"),
        (["--output", "missing/report.html"], "does not exist"),
    ],
)
def test_wrong_input_ends_with_2_before_the_run(
    call, runs, passage, tmp_path, monkeypatch, arguments, part
):
    monkeypatch.chdir(tmp_path)
    seen = runs(passage)
    answer = call(*arguments)
    assert answer.exit_code == 2
    assert part in answer.stderr
    assert (answer.stdout, seen, [*tmp_path.iterdir()]) == ("", [], [])


def test_what_would_change_a_result_is_refused(call, result):
    answer = call(result, "--set", "flat.depth=1e-3")
    assert answer.exit_code == 2
    assert "cannot change" in answer.stderr


def test_another_netcdf_file_is_refused(call, tmp_path):
    path = tmp_path / "other.nc"
    xr.Dataset({"a": ("time", [1.0, 2.0])}).to_netcdf(path, engine="h5netcdf")
    answer = call(path)
    assert answer.exit_code == 2
    assert "is not the result of a passage" in answer.stderr


def test_a_missing_library_is_named_with_its_remedy(call, monkeypatch):
    found = importlib.util.find_spec
    monkeypatch.setattr(
        "importlib.util.find_spec", lambda name: None if name == "plotly" else found(name)
    )
    answer = call()
    assert answer.exit_code == 2
    assert "pip install 'railcosim[report]'" in answer.stderr


def test_a_run_that_fails_is_shown_as_far_as_it_came(call, runs, passage, tmp_path):
    partial = passage.isel(time=slice(0, 50)).assign_attrs(complete=0, stop_reason="it stuck")
    runs(RunError("it stuck at t = 0.01 s", result=partial))
    output = tmp_path / "report.html"
    answer = call("--output", output)
    assert answer.exit_code == 1
    assert "it stuck at t = 0.01 s" in answer.stderr
    assert "The run ended early" in output.read_text(encoding="utf-8")
