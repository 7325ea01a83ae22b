import json
import signal
import subprocess
import sys
from pathlib import Path

import pytest
import xarray as xr
from typer.testing import CliRunner

import railcosim
from orchestrator import Verdict
from railcosim import cli
from railcosim.errors import InputError, RunError

DISTANCE = [-3.9, -0.2, 0.0, 0.9, 2.6]


@pytest.fixture
def call():
    """Run the command line without anything behind it."""

    def call(*arguments):
        return CliRunner().invoke(cli.app, [str(argument) for argument in arguments])

    return call


@pytest.fixture
def runs(monkeypatch, make_passage):
    """Let `run` end as it should end, and tell which scenarios were run."""
    seen = []

    def runs(*, ends=None, complete=True, unreliable=""):
        def run_passage(scenario, **_):
            seen.append(scenario)
            if ends is not None:
                raise ends
            distance = DISTANCE if complete else DISTANCE[:2]
            return make_passage(distance, scenario, complete=complete, unreliable=unreliable)

        monkeypatch.setattr("railcosim.commands.run.run_passage", run_passage)
        return seen

    return runs


def one_sentence(result):
    """Give the only line on stderr, after its prefix; there must be no traceback."""
    (line,) = result.stderr.splitlines()
    assert line.startswith("railcosim: ")
    assert "Traceback" not in result.output
    return line


def test_version(call):
    result = call("--version")
    assert (result.exit_code, result.stdout) == (0, f"railcosim {railcosim.__version__}\n")


def test_help_names_the_commands(call):
    assert call("--help").exit_code == 0
    assert {"run", "cosim", "build"} <= set(call("--help").stdout.split())


def test_a_run_prints_a_table(call, runs):
    seen = runs()
    result = call("run", "--set", "vehicle.speed_kmh=35", "--fmus", "python")
    assert result.exit_code == 0
    assert result.stderr == ""
    assert "largest contact force" in result.stdout
    assert "35 km/h" in result.stdout
    assert seen[0].vehicle.speed_kmh == 35.0


def test_json_is_one_object_and_nothing_else(call, runs):
    runs()
    result = call("run", "--json")
    assert result.exit_code == 0
    assert result.stderr == ""
    assert json.loads(result.stdout)["steps"]["accepted"] == len(DISTANCE) - 1


def test_quiet_says_nothing(call, runs):
    runs()
    assert call("run", "--quiet").output == ""
    assert json.loads(call("run", "--quiet", "--json").output)["wall_time"] == 1.5


def test_a_scenario_file_is_read_and_the_files_are_written(call, runs, tmp_path):
    seen = runs()
    scenario = tmp_path / "case.toml"
    scenario.write_text("[flat]\nshape = 'none'\n")
    output, plot = tmp_path / "passage.nc", tmp_path / "passage.png"
    result = call("run", scenario, "--output", output, "--plot", plot)
    assert result.exit_code == 0
    assert seen[0].flat.shape == "none"
    with xr.open_dataset(output, engine="h5netcdf") as stored:
        assert stored.sizes["time"] == len(DISTANCE)
    assert plot.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        (["--set", "vehicle.sped_kmh=40"], "vehicle.speed_kmh"),
        (["--set", "flat.depth=-1e-3"], "at least 0 m"),
        (["--set", "flat.length=100"], "the length of the track"),
        (["--set", "run.approach=20"], "the track begins at 0 m"),
        (["--set", "run.departure=20"], "the track ends at 32.5 m"),
        (["--set", "vehicle.speed_kmh=0"], "at least 0.1 km/h"),
        (["--timeout", "5"], "without --isolate"),
        (["--isolate", "--timeout", "0"], "above 0 s"),
        (["missing.toml"], "No such file"),
        (["--output", "passage.txt"], "--output passage.txt"),
        (["--output", "missing/passage.nc"], "does not exist"),
        (["--plot", "passage.gif"], "--plot passage.gif"),
    ],
)
def test_wrong_input_ends_with_2_before_the_run(call, runs, tmp_path, monkeypatch, arguments, part):
    monkeypatch.chdir(tmp_path)
    seen = runs()
    result = call("run", *arguments)
    assert result.exit_code == 2
    assert part in one_sentence(result)
    assert (result.stdout, seen, [*tmp_path.iterdir()]) == ("", [], [])


@pytest.mark.parametrize(
    "arguments",
    [["run", "--unknown"], ["run", "--fmus", "fortran"], ["run", "a.toml", "b.toml"], ["walk"]],
)
def test_wrong_usage_ends_with_2(call, runs, arguments):
    seen = runs()
    result = call(*arguments)
    assert (result.exit_code, result.stdout, seen) == (2, "", [])
    assert "Error" in result.stderr


@pytest.mark.parametrize(
    ("ends", "code", "part"),
    [
        (InputError("table v.csv: has no rows"), 2, "v.csv"),
        (RunError("track: the step failed at t = 0.1 s"), 1, "at t = 0.1 s"),
        (KeyboardInterrupt(), 1, "interrupted"),
    ],
)
def test_a_failed_run_says_why_and_writes_nothing(call, runs, tmp_path, ends, code, part):
    runs(ends=ends)
    result = call("run", "--output", tmp_path / "passage.nc")
    assert result.exit_code == code
    assert part in one_sentence(result)
    assert (result.stdout, [*tmp_path.iterdir()]) == ("", [])


def test_an_interrupted_run_ends_with_1_and_a_valid_result(call, runs, tmp_path):
    runs(complete=False)
    path = tmp_path / "passage.nc"
    result = call("run", "--json", "--output", path, "--plot", tmp_path / "passage.png")
    assert result.exit_code == 1
    assert "it was interrupted" in one_sentence(result)
    assert json.loads(result.stdout)["peak_contact_force"] is None
    with xr.open_dataset(path, engine="h5netcdf") as stored:
        assert stored.attrs["complete"] == 0


def test_a_wrong_result_is_written_and_ends_with_1(call, runs, tmp_path):
    runs(unreliable="The steps are too large.")
    path = tmp_path / "passage.nc"
    result = call("run", "--json", "--output", path)
    assert result.exit_code == 1
    assert one_sentence(result) == "railcosim: the result is wrong: The steps are too large."
    assert json.loads(result.stdout)["unreliable"] == ["The steps are too large."]
    with xr.open_dataset(path, engine="h5netcdf") as stored:
        assert stored.attrs["unreliable"] == "The steps are too large."


@pytest.mark.parametrize(("holds", "code"), [(True, 0), (None, 0), (False, 1)])
def test_check_prints_verdicts_and_ends_with_1_if_one_fails(call, monkeypatch, holds, code):
    verdict = Verdict(claim="states are freed", holds=holds, detail="10 bytes per state")
    monkeypatch.setattr("railcosim.commands.check.check_fmu", lambda *_, **__: [verdict])
    result = call("check", "some.fmu")
    assert result.exit_code == code
    assert "10 bytes per state" in result.stdout
    if code:
        assert "some.fmu: it does not hold that states are freed" in one_sentence(result)
    parsed = json.loads(call("check", "some.fmu", "--json").stdout)
    assert parsed["states are freed"]["holds"] is holds


def test_check_of_no_fmu_ends_with_2(call):
    result = call("check", "missing.fmu")
    assert result.exit_code == 2
    assert "there is no such FMU file" in one_sentence(result)


def test_build_writes_fmus_and_their_systems_and_leaves_them_alone(call, tmp_path):
    result = call("build", "--output", tmp_path)
    assert result.exit_code == 0
    names = [
        *("Track.fmu", "Vehicle.fmu", "Passage.ssp"),
        *("TrackContact.fmu", "Masses.fmu", "contact_on_track/PassageContactOnTrack.ssp"),
    ]
    assert result.stdout.split() == [str(tmp_path / name) for name in names]
    built = [line.split()[-1] for line in result.stderr.splitlines()]
    assert built == [Path(name).name for name in names]
    again = call("build", "--output", tmp_path)
    assert (again.exit_code, again.stdout, again.stderr) == (0, result.stdout, "")


def test_build_says_where_it_cannot_write(call, tmp_path):
    blocked = tmp_path / "file"
    blocked.write_text("")
    result = call("build", "--output", blocked)
    assert result.exit_code == 1
    assert str(blocked) in result.stderr.splitlines()[-1]
    assert "Traceback" not in result.output


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["run", "--fmus", "compiled"], "'compiled' is not"),
        (["run", "a.toml", "b.toml"], "b.toml"),
        (["--nosuch"], "--nosuch"),
        (["run", "--set", "master.algorithm=jacobi"], "takes steps of one size only"),
        (["run", "--set", "flat.shape=~no-such-user/x.csv"], "no usable path"),
        (["run", "--set", "track.bays=0x" + "f" * 5000], "too long to show"),
        (["run", "--set", "vehicle.speed_kmh=" + "[" * 3000], "must be a number in km/h"),
        (["run", "--set", "track.bays=1000"], "at most 10000 can be solved"),
        (["run", "--output", "x" * 253 + ".nc"], "no usable name"),
        (["run", "--set", "master.min_step=1"], "master.min_step is 1 s"),
    ],
)
def test_wrong_command_lines_end_with_2_and_one_line(arguments, message, monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["railcosim", *arguments])
    monkeypatch.setattr(signal, "signal", lambda *_: None)
    with pytest.raises(SystemExit) as end:
        cli.main()
    out, err = capsys.readouterr()
    assert end.value.code == 2
    assert message in err
    assert err.count("\n") == 1
    assert out == ""


def test_a_wrong_command_line_of_the_module_ends_the_same_way():
    command = [sys.executable, "-m", "railcosim", "--nosuch"]
    answer = subprocess.run(command, check=False, capture_output=True, text=True)
    assert (answer.returncode, answer.stdout) == (2, "")
    assert "--nosuch" in answer.stderr
    assert answer.stderr.count("\n") == 1


def test_a_passage_that_fails_keeps_its_result_and_can_be_replayed(tmp_path):
    """A tolerance that the smallest step allowed cannot meet."""
    keys = ("tolerance=1e-7", "min_step=1e-4")
    options = [word for key in keys for word in ("--set", f"master.{key}")]
    output, runner = tmp_path / "passage.nc", CliRunner()
    failed = runner.invoke(cli.app, ["run", "--quiet", "--output", str(output), *options])
    assert failed.exit_code == 1
    with xr.open_dataset(output, engine="h5netcdf") as stored:
        assert stored.attrs["complete"] == 0
        assert stored.attrs["stop_reason"] in failed.stderr
    answer = runner.invoke(cli.app, ["replay", str(tmp_path / "passage.replay"), "--json"])
    assert (answer.exit_code, answer.stderr) == (0, "")
    numbers = json.loads(answer.stdout)
    assert numbers["reproduced"]
    assert not numbers["from_start"]
    assert {step["participant"] for step in numbers["steps"]} == {"vehicle", "track"}


@pytest.mark.parametrize("ctrl_c", [signal.SIG_IGN, signal.default_int_handler])
def test_sigterm_ends_a_run_also_where_ctrl_c_is_ignored(monkeypatch, ctrl_c):
    """A shell starts what stands before & with Ctrl-C ignored."""
    monkeypatch.setattr(cli, "app", lambda *_, **__: signal.raise_signal(signal.SIGTERM))
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        signal.signal(signal.SIGINT, ctrl_c)
        with pytest.raises(KeyboardInterrupt):
            cli.main()
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def test_ctrl_c_while_modules_are_loaded_leaves_no_traceback():
    """The process then ends by the signal itself, as a shell expects."""
    code = (
        "import signal, sys\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "class CtrlC:\n"
        "    def find_spec(self, name, *_):\n"
        "        if name == 'railcosim.cli':\n"
        "            signal.raise_signal(signal.SIGINT)\n"
        "sys.meta_path.insert(0, CtrlC())\n"
        "from railcosim.__main__ import main\n"
        "main()\n"
    )
    command = [sys.executable, "-c", code]
    ended = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)
    assert ended.returncode == -signal.SIGINT
    assert ended.stderr == ""
