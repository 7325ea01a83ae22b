"""Passages over native FMUs: the results of the Python ones, other tracks, who runs by default."""

from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from fmu_src.building import KINDS
from fmu_src.native import compiler
from railcosim import builds, cli
from railcosim.builds import build_for, usual_build
from railcosim.errors import InputError, RunError
from railcosim.passage import run_passage
from railcosim.scenario_file import read_scenario

AGREEMENT = 1e-9  # of the largest value of a history
SHORT = ("run.approach=0.15", "run.departure=0.11")
STEP_LOG = ("attempt_time", "attempt_step_size", "attempt_cause")
HISTORIES = (
    "contact_force",
    "gap",
    "wheel_displacement",
    "wheel_velocity",
    "rail_displacement",
    "rail_velocity",
    "sleeper_displacement",
    "pad_force",
    "ballast_force",
    "bending_moment",
    "bending_moment_under_wheel",
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("built")


def assert_same(case, folder):
    """Step sizes and decisions are the same; only the first guess of a Jacobian may differ."""
    python, native = (run_passage(case, fmus=kind, directory=folder / kind) for kind in KINDS)
    for name in STEP_LOG:
        assert (python[name].to_numpy() == native[name].to_numpy()).all(), name
    for name in HISTORIES:
        expected = python[name].to_numpy()
        limit = AGREEMENT * np.max(np.abs(expected))
        np.testing.assert_allclose(native[name], expected, rtol=0.0, atol=limit, err_msg=name)
    return native


def test_a_passage_over_the_flat_is_that_of_the_python_fmus(folder):
    native = assert_same(read_scenario(None, SHORT), folder)
    assert native.attrs["fmus"] == "native"


@pytest.mark.slow
def test_the_default_passage_is_that_of_the_python_fmus(folder):
    assert_same(read_scenario(None, ()), folder)


def test_another_track_has_its_own_fmu(folder):
    """Shorter, and softer than the paper's; the second run builds nothing."""
    changes = ("track.bays=40", "track.pad_stiffness=1e8", "flat.position=13.0", *SHORT)
    said = []
    case = read_scenario(None, changes)
    native = run_passage(case, fmus="native", directory=folder / "native", notify=said.append)
    assert any(text.startswith("building Track-40bays-basis-") for text in said)
    built = build_for(case, "native", directory=folder / "native", notify=said.append)
    assert len([text for text in said if text.startswith("building Track")]) == 1
    assert built.track.is_file()
    python = run_passage(case, directory=folder / "python")
    expected = python["contact_force"].to_numpy()
    np.testing.assert_allclose(native["contact_force"], expected, rtol=1e-8)


def test_the_native_build_runs_where_it_exists(tmp_path, monkeypatch):
    monkeypatch.setattr(builds, "folder_of", lambda _: tmp_path)
    assert usual_build("vehicle") == "python"
    for name in ("Track.fmu", "Vehicle.fmu"):
        assert usual_build("vehicle") == "python"
        (tmp_path / name).touch()
    assert usual_build("vehicle") == "native"
    assert usual_build("track") == "python"
    for name in ("TrackContact.fmu", "Masses.fmu"):
        (tmp_path / name).touch()
    assert usual_build("track") == "native"


def test_what_there_is_no_native_build_of(tmp_path):
    case = read_scenario(None, SHORT)
    with pytest.raises(InputError, match="must be python or native"):
        build_for(case, "compiled", directory=tmp_path)


def test_without_a_compiler_the_way_out_is_named(tmp_path, monkeypatch):
    monkeypatch.setenv("RAILCOSIM_CACHE", str(tmp_path))
    monkeypatch.setattr(compiler, "find_spec", lambda _: None)
    with pytest.raises(RunError, match=r"'ziglang'.*; or run with --fmus python$"):
        build_for(read_scenario(None, SHORT), "native", directory=tmp_path)


def test_the_command_line_builds_for_chosen_platforms(folder):
    target = compiler.this_target()
    command = [
        "build",
        "--kind",
        "native",
        "--output",
        str(folder / "native"),
        "--platform",
        target,
    ]
    answer = CliRunner().invoke(cli.app, command)
    assert answer.exit_code == 0, answer.output
    names = [Path(line).name for line in answer.stdout.split()]
    assert names == [
        "Track.fmu", "Vehicle.fmu", "Passage.ssp", "Track-fmi3.fmu", "Vehicle-fmi3.fmu",
        "TrackContact.fmu", "Masses.fmu", "PassageContactOnTrack.ssp",
        "TrackContact-fmi3.fmu", "Masses-fmi3.fmu",
    ]  # fmt: skip
    for wrong, message in (
        (["--kind", "native", "--platform", "riscv64-linux"], "must be one of"),
        (["--platform", target], "is for --kind native"),
    ):
        answer = CliRunner().invoke(cli.app, ["build", "--output", str(folder), *wrong])
        assert answer.exit_code == 2
        assert message in answer.stderr
