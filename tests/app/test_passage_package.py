import subprocess
import sys
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fmu_src.building import folder_of
from orchestrator import System
from orchestrator.ssp import open_system
from railcosim.builds import build_for
from railcosim.cosim import run_system
from railcosim.cosim_options import CosimOptions
from railcosim.coupled_system import connections, indicators, master_settings
from railcosim.dataset import count
from railcosim.passage import run_passage
from railcosim.passage_package import ensure_package
from railcosim.scenario import Scenario
from railcosim.sections import Flat, Run
from railcosim.signals import BODY_SIGNALS, SIGNALS, SLEEPER_SIGNALS

SHORT = Scenario(flat=Flat(depth=2e-3), run=Run(approach=0.1, departure=0.1))
"""A deep flat strikes: contact is lost and found again within 18 ms."""


@pytest.fixture(scope="module")
def fmus():
    return build_for(Scenario(), directory=folder_of("python"))


def test_the_package_runs_the_same_passage(fmus, tmp_path):
    """Asserted are 1e-9 of the largest value; the two take the same steps with the same numbers."""
    path = tmp_path / "short.ssp"
    ensure_package(SHORT, fmus, path)
    passage = run_passage(SHORT)
    system = run_system(path, CosimOptions())
    assert passage.attrs["switches"] == system.attrs["switches"] > 0
    assert system["time"].to_numpy() == pytest.approx(passage["time"].to_numpy(), abs=1e-15)
    left = {str(name) for name, series in system.data_vars.items() if series.dims == ("time",)}
    for signal in SIGNALS:
        for k in passage[signal.dim].to_numpy():
            expected = passage[signal.name].sel({signal.dim: k}).to_numpy().astype(float)
            scale = 1e-9 * np.abs(expected).max()
            assert system[signal.path(k)].to_numpy() == pytest.approx(expected, rel=0, abs=scale)
            left.remove(signal.path(k))
    # what the result of a passage has of suspended vehicles and bending sleepers only
    suspended = replace(SHORT, vehicle=replace(SHORT.vehicle, model="suspended"))
    # and of endless tracks only
    left.remove("track.window_position")
    assert left == {
        signal.path(k)
        for signal in (*BODY_SIGNALS, *SLEEPER_SIGNALS)
        for k in range(1, count(suspended)[signal.dim] + 1)
    }
    assert not any(system[name].any() for name in left)


def test_the_package_with_contact_on_the_track_runs_the_same_passage(tmp_path):
    """Any tool that passes values on between its steps does what the master does with it."""
    paths = build_for(SHORT, contact="track")
    path = tmp_path / "short.ssp"
    ensure_package(SHORT, paths, path, contact="track")
    with open_system(path) as opened:
        master = opened.description.master
        assert (master.settings["algorithm"], master.settings["extrapolate"]) == ("jacobi", False)
        assert master.events == ()
        assert opened.unused == ()
    passage = run_passage(SHORT, contact="track")
    system = run_system(path, CosimOptions())
    for name in ("contact_force", "gap", "rail_displacement", "bending_moment"):
        signal = next(item for item in SIGNALS if item.name == name)
        for k in passage[signal.dim].to_numpy():
            expected = passage[name].sel({signal.dim: k}).to_numpy()
            assert (system[signal.path(k, "track")].to_numpy() == expected).all(), name


def test_the_package_of_the_papers_case(fmus, tmp_path):
    path = tmp_path / "Passage.ssp"
    told = []
    ensure_package(Scenario(), fmus, path, notify=told.append)
    with zipfile.ZipFile(path) as archive:
        assert archive.namelist() == [
            "SystemStructure.ssd",
            "resources/Track.fmu",
            "resources/Vehicle.fmu",
        ]
    with open_system(path) as opened:
        description = opened.description
        assert isinstance(opened.system, System)
        ends = [(item.source, item.target) for item in opened.system.connections]
        assert opened.unused == ()
    assert ends == [(item.source, item.target) for item in connections(Scenario())]
    assert description.start_time == 0.0
    # 6.5 m at 40 km/h
    assert description.stop_time == pytest.approx(0.585, rel=1e-15)
    assert description.master.events == tuple(indicators(2))
    chosen = CosimOptions().settings(description.master)
    assert chosen == master_settings(Scenario())
    assert told == ["building Passage.ssp"]


def test_the_same_passage_gives_the_same_bytes_and_is_left_alone(fmus, tmp_path):
    first, second = tmp_path / "first.ssp", tmp_path / "second.ssp"
    ensure_package(SHORT, fmus, first)
    ensure_package(SHORT, fmus, second)
    assert first.read_bytes() == second.read_bytes()
    told = []
    ensure_package(SHORT, fmus, second, notify=told.append)
    assert told == []
    ensure_package(Scenario(), fmus, second, notify=told.append)
    assert told == ["building second.ssp"]
    second.write_bytes(first.read_bytes()[:-100])
    ensure_package(SHORT, fmus, second)
    assert first.read_bytes() == second.read_bytes()


def test_the_build_script_writes_the_package_too(tmp_path):
    script = Path(__file__).resolve().parents[2] / "build_fmus.py"
    done = subprocess.run(
        [sys.executable, script, "--output", tmp_path], capture_output=True, text=True, check=True
    )
    names = [
        *("Track.fmu", "Vehicle.fmu", "Passage.ssp"),
        *("TrackContact.fmu", "Masses.fmu", "contact_on_track/PassageContactOnTrack.ssp"),
    ]
    assert done.stdout.split() == [str(tmp_path / name) for name in names]
    found = [path for path in tmp_path.rglob("*") if path.is_file()]
    assert sorted(found) == sorted(tmp_path / name for name in names)
