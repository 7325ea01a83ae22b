"""`railcosim cosim` when something goes wrong: what it says, how fast, and what it leaves."""

import json
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
import ssd_text as t
import xarray as xr
from typer.testing import CliRunner

from railcosim import cli


@pytest.fixture
def call():
    return lambda *arguments: CliRunner().invoke(cli.app, [*map(str, arguments)])


@pytest.fixture
def masses(faulty, tmp_path):
    """Write two masses that push each other, the second with faults, and return the file."""

    def write(trouble, attributes='fixed_step="0.01"', label="", stop=1.0, linked=True):
        parameters = t.bindings(
            t.parameters(
                ("trouble", f'<ssv:Integer value="{trouble}"/>'),
                ("label", f'<ssv:String value="{label}"/>'),
            )
        )
        ends = t.connectors(inputs=("force",), outputs=("x",))
        system = t.ssd(
            [
                t.component("one", ends, source=faulty.name),
                t.component("two", ends + parameters, source=faulty.name),
            ],
            "".join(
                f'<ssd:Connection startElement="{a}" startConnector="x" endElement="{b}" '
                f'endConnector="force"/>'
                for a, b in (("one", "two"), ("two", "one"))
                if linked
            ),
            root=f'<ssd:DefaultExperiment startTime="0" stopTime="{stop}"/>' + t.master(attributes),
        )
        (tmp_path / faulty.name).write_bytes(faulty.read_bytes())
        path = tmp_path / "masses.ssd"
        path.write_text(system, encoding="utf-8")
        return path

    return write


def one_sentence(result):
    (line,) = result.stderr.splitlines()
    assert line.startswith("railcosim: ")
    return line


def test_a_failed_run_leaves_a_valid_result_and_a_replay_file(masses, call, tmp_path):
    output = tmp_path / "r.nc"
    result = call("cosim", masses(9, 'fixed_step="0.01" min_step="0.001"'), "--output", output)
    assert (result.exit_code, result.stdout) == (1, "")
    said = one_sentence(result)
    assert "two: its value of x is not finite at t = 0.5" in said
    assert f"railcosim replay {tmp_path / 'r.replay'}" in said
    with xr.open_dataset(output, engine="h5netcdf") as stored:
        assert stored.attrs["complete"] == 0
        assert "two: its value of x is not finite" in stored.attrs["stop_reason"]
        assert stored["time"][-1] == stored.attrs["simulated_time"] > 0.5
        assert stored["attempt_cause"][-1] == "invalid"
    assert {path.name for path in tmp_path.iterdir()} == {
        "r.nc",
        "r.replay",
        "masses.ssd",
        "FaultyMass.fmu",
    }


def test_a_failure_is_replayed_without_the_files_it_came_from(masses, call, tmp_path):
    system = masses(9, 'fixed_step="0.01" min_step="0.001"')
    replay = tmp_path / "why.replay"
    failed = call("cosim", system, "--replay", replay)
    assert failed.exit_code == 1
    for path in (system, tmp_path / "FaultyMass.fmu"):
        path.unlink()
    shown = call("replay", replay)
    assert (shown.exit_code, shown.stderr) == (0, "")
    assert "force = " in shown.stdout
    assert "x = nan" in shown.stdout
    numbers = json.loads(call("replay", replay, "--json").stdout)
    assert numbers["reproduced"]
    assert numbers["error"] in one_sentence(failed)
    assert numbers["repeated"].rstrip(".") in numbers["error"]
    assert numbers["steps"][-1]["participant"] == "two"
    assert numbers["steps"][-1]["outputs"] == {"x": "nan"}


def test_no_replay_file_without_being_asked(masses, call, tmp_path):
    assert call("cosim", masses(2)).exit_code == 1
    assert [*tmp_path.glob("*.replay")] == []
    refused = call("cosim", masses(2), "--replay", tmp_path / "r.zip")
    assert refused.exit_code == 2
    assert call("replay", tmp_path / "no.replay").exit_code == 2


def test_a_crash_is_named(masses, call):
    result = call("cosim", masses(6), "--isolate", "--quiet")
    assert result.exit_code == 1
    said = one_sentence(result)
    assert "two: its process was ended by SIGSEGV in the step" in said
    assert "at t = 0.51 s over a step of 0.01 s with force = " in said


def test_a_hang_is_named_within_the_time_out(masses, call, tmp_path):
    began = time.perf_counter()
    result = call("cosim", masses(8), "--isolate", "--timeout", 6, "--output", tmp_path / "r.nc")
    # The time-out, once, and what starting processes takes.
    assert time.perf_counter() - began < 20.0
    assert result.exit_code == 1
    assert "two: its process gave no answer within 6 s" in one_sentence(result)
    with xr.open_dataset(tmp_path / "r.nc", engine="h5netcdf") as stored:
        assert stored["time"].to_numpy()[-1] == pytest.approx(0.51)


def test_a_crash_that_was_survived_is_told_as_a_doubt(masses, call, tmp_path):
    system = masses(6, label=str(tmp_path / "fuse"))
    result = call("cosim", system, "--isolate", "--json")
    assert result.exit_code == 0
    assert "two: its process was ended by SIGSEGV" in one_sentence(result)
    assert "it was started anew and went on from there" in one_sentence(result)
    assert json.loads(result.stdout)["end_time"] == 1.0


@pytest.mark.parametrize(
    ("number", "isolation"),
    [
        (signal.SIGINT, []),
        (signal.SIGTERM, ["--isolate"]),
        pytest.param(signal.SIGTERM, [], marks=pytest.mark.slow),
        pytest.param(signal.SIGINT, ["--isolate"], marks=pytest.mark.slow),
    ],
)
def test_a_signal_leaves_a_valid_result_and_nothing_else(masses, tmp_path, number, isolation):
    system, output = masses(0, stop=1e6, linked=False), tmp_path / "r.nc"
    scratch = tmp_path / "scratch"
    scratch.mkdir()
    command = [sys.executable, "-m", "railcosim", "cosim", str(system), "--output", str(output)]
    process = subprocess.Popen(
        [*command, "--quiet", *isolation],
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "TMPDIR": str(scratch), "PYTHONPATH": os.pathsep.join(sys.path)},
    )
    deadline = time.monotonic() + 60.0
    # Both FMUs are unpacked when the run is about to begin.
    while len([*scratch.iterdir()]) < 2 and process.poll() is None:
        assert time.monotonic() < deadline
        time.sleep(0.05)
    time.sleep(2.0)
    process.send_signal(number)
    _, said = process.communicate(timeout=60.0)
    assert process.returncode == 1
    assert "because it was interrupted" in said
    assert "Traceback" not in said
    assert len(said.splitlines()) == 1
    with xr.open_dataset(output, engine="h5netcdf") as stored:
        assert stored.attrs["complete"] == 0
        steps = stored["time"].size
        assert steps > 1
        assert np.array_equal(stored["time"], 0.01 * np.arange(steps))
    assert [*scratch.iterdir()] == []
    assert [path for path in tmp_path.iterdir() if path.name.startswith(".")] == []


def test_a_signal_while_setting_up_leaves_nothing(masses):
    code = (
        "import signal, sys, railcosim.cosim as c\n"
        "from railcosim.cli import main\n"
        "def interrupted(*a, **k): signal.raise_signal(signal.SIGTERM)\n"
        "c.open_system = interrupted\n"
        "main()\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, "cosim", str(masses(0))],
        capture_output=True,
        text=True,
        timeout=60.0,
        check=False,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    )
    assert done.returncode == 1
    assert done.stderr.splitlines() == ["railcosim: interrupted before there was anything to keep"]
