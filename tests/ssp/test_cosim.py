"""The command `railcosim cosim` on small systems."""

import csv
import json

import pytest
import ssd_text as t
import xarray as xr
from typer.testing import CliRunner

from railcosim import cli

rates = t.bindings(t.parameters(("start", '<ssv:Real value="-1"/>')))


@pytest.fixture
def call():
    return lambda *arguments: CliRunner().invoke(cli.app, ["cosim", *map(str, arguments)])


def one_sentence(result):
    """Give the only line on stderr, after its prefix; there must be no traceback."""
    (line,) = result.stderr.splitlines()
    assert line.startswith("railcosim: ")
    return line


def a_system(attributes='fixed_step="0.25"', inner="", values=""):
    first = t.component("a", t.connectors() + values)
    return t.ssd([first, t.component("b")], root=t.experiment + t.master(attributes, inner))


def test_the_numbers_as_json(put, call):
    result = call(put(a_system()), "--json")
    assert (result.exit_code, result.stderr) == (0, "")
    numbers = json.loads(result.stdout)
    assert numbers["warnings"] == numbers["unreliable"] == []
    assert set(numbers) == {"end_time", "steps", "wall_time", "warnings", "unreliable", "final"}
    assert numbers["end_time"] == 1.5
    assert numbers["steps"]["accepted"] == 4
    assert set(numbers["steps"]["rejected"]) == {
        "error",
        "event",
        "convergence",
        "discard",
        "invalid",
    }
    # Boolean and Integer outputs stay what they are.
    assert numbers["final"] == {
        "a.y": 1.5,
        "a.seen": 0.0,
        "a.double": 0.0,
        "a.counted": 0,
        "a.raised": True,
        "b.y": 1.5,
        "b.seen": 1.5,
        "b.double": 3.0,
        "b.counted": 0,
        "b.raised": True,
    }


@pytest.mark.parametrize(
    ("bond", "part"),
    [
        ("a.y", "--bond a.y must name two outputs"),
        ("a.y,b.nothing", "b has no variable 'nothing'"),
        ("a.y,a.y", "a.y declares no unit"),
    ],
)
def test_what_is_no_bond_ends_with_2(put, call, bond, part):
    result = call(put(a_system()), "--bond", bond)
    assert result.exit_code == 2
    assert part in " ".join(result.stderr.split())


def test_an_audit_is_reported_as_json(put, call):
    numbers = json.loads(call(put(a_system()), "--json", "--audit", "2").stdout)
    assert numbers["audit"]["steps"] == 2
    assert numbers["audit"]["optimism"] is None
    assert call(put(a_system()), "--audit", "0").exit_code == 2


def test_a_table_without_json_and_nothing_when_quiet(put, call):
    path = put(a_system())
    shown = call(path)
    assert shown.exit_code == 0
    assert "b.seen" in shown.stdout
    assert "accepted steps" in shown.stdout
    assert call(path, "--quiet").output == ""


def test_the_result_has_all_outputs_and_the_step_log(put, call, tmp_path):
    path = put(a_system())
    netcdf, table = tmp_path / "r.nc", tmp_path / "r.csv"
    assert call(path, "--quiet", "--output", netcdf).exit_code == 0
    assert call(path, "--quiet", "--output", table).exit_code == 0
    with xr.open_dataset(netcdf, engine="h5netcdf") as stored:
        assert stored["b.seen"].to_numpy().tolist() == [0.0, 0.75, 1.0, 1.25, 1.5]
        assert stored["time"].to_numpy().tolist() == [0.5, 0.75, 1.0, 1.25, 1.5]
        assert stored["attempt_cause"].to_numpy().tolist() == ["accepted"] * 4
        assert {"units", "long_name"} <= set(stored["a.y"].attrs)
        assert json.loads(stored.attrs["master"])["fixed_step"] == 0.25
    with table.open(encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    assert header[:2] == ["time [s]", "a.y [1]"]
    assert len(rows) == 5


def test_options_count_more_than_the_file(put, call):
    result = call(put(a_system()), "--stop-time", 2.5, "--step", 0.5, "--json")
    numbers = json.loads(result.stdout)
    assert (numbers["end_time"], numbers["steps"]["accepted"]) == (2.5, 4)


def test_events_of_the_file_and_of_the_command_line_are_landed_on(put, call, tmp_path):
    """`a.y` runs from -1 with rate 1 and meets zero at t = 1, between the steps of 0.4 s."""
    path = tmp_path / "r.nc"
    for system, options in (
        (a_system('fixed_step="0.4"', '<Event indicator="a.y"/>', rates), []),
        (a_system('fixed_step="0.4"', "", rates), ["--event", "a.y", "--event", "b.y"]),
    ):
        assert call(put(system), "--quiet", "--output", path, *options).exit_code == 0
        with xr.open_dataset(path, engine="h5netcdf") as stored:
            assert stored.attrs["switches"] == 1
            # Located to 1e-10 in the indicator, whose rate is one.
            assert abs(stored["a.y"].to_numpy()).min() <= 1e-10


def test_values_that_no_variable_takes_are_named(put, call):
    values = t.bindings(t.parameters(("strat", '<ssv:Real value="1"/>')))
    result = call(put(a_system(values=values)), "--json")
    assert result.exit_code == 0
    assert "a.strat" in one_sentence(result)


@pytest.mark.parametrize(
    ("text", "options", "part"),
    [
        (t.ssd(), [], "give --stop-time"),
        (a_system(), ["--stop-time", "0.5"], "later than the start time, 0.5 s"),
        (a_system(), ["--step", "0.1", "--max-step", "1"], "leaves --max-step 1 no meaning"),
        (a_system(), ["--event", "a.z"], "a has no variable 'z'"),
        (a_system(), ["--tolerance", "-1"], "must be positive and finite"),
        (a_system(), ["--output", "r.txt"], "--output r.txt"),
        (a_system('algorithm="magic"'), [], "algorithm 'magic' is none of"),
        ("<a/>", [], "the root element must be"),
    ],
)
def test_wrong_input_ends_with_2(put, call, tmp_path, monkeypatch, text, options, part):
    monkeypatch.chdir(tmp_path)
    result = call(put(text), *options)
    assert (result.exit_code, result.stdout) == (2, "")
    assert part in one_sentence(result)


def test_a_missing_file_ends_with_2(call, tmp_path):
    result = call(tmp_path / "no.ssp")
    assert result.exit_code == 2
    assert "there is no such file" in one_sentence(result)


def test_a_run_that_fails_ends_with_1_and_names_the_fmu(put, call, tmp_path):
    values = t.bindings(t.parameters(("label", '<ssv:String value="stop"/>')))
    result = call(put(a_system(values=values)), "--json", "--output", tmp_path / "r.nc")
    assert (result.exit_code, result.stdout) == (1, "")
    assert one_sentence(result).startswith("railcosim: a: ")
    assert not (tmp_path / "r.nc").exists()


def test_a_run_that_ends_early_ends_with_1_and_a_valid_result(put, call, tmp_path):
    path = tmp_path / "r.nc"
    system = put(a_system('fixed_step="0.25" max_attempts="2"'))
    result = call(system, "--json", "--output", path)
    assert result.exit_code == 1
    assert "the largest number of attempts was reached" in one_sentence(result)
    assert json.loads(result.stdout)["end_time"] == 1.0
    with xr.open_dataset(path, engine="h5netcdf") as stored:
        assert stored.attrs["complete"] == 0
        assert stored["time"].to_numpy().tolist() == [0.5, 0.75, 1.0]
