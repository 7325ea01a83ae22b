"""The paper's demonstration example, through both FMUs and the master."""

import json
import subprocess
import sys
from math import inf

import numpy as np
import pytest

from railcosim.errors import RunError
from railcosim.passage import run_passage
from railcosim.scenario_file import read_scenario

from .full_model import FullModel, haversine
from .reference_case import NEAR, SPEED, STATIC_LOAD

pytestmark = pytest.mark.xdist_group("passage")  # they share runs

FLAT = 16.6
CIRCUMFERENCE = 2.0 * np.pi * 0.45


def single(position):
    return haversine(position - FLAT)


def periodic(position):
    return haversine((position - FLAT + CIRCUMFERENCE / 2) % CIRCUMFERENCE - CIRCUMFERENCE / 2)


def test_an_explicit_run_that_cannot_work_is_refused():
    """It would end with 60 MN where the truth is 234 kN."""
    scenario = read_scenario(None, ("master.algorithm=jacobi", "master.step=1e-4"))
    with pytest.raises(RunError, match=r"gain of 0\.5\d+ over a step of 0\.0001 s.*newton"):
        run_passage(scenario)


@pytest.mark.slow
def test_an_explicit_run_that_only_jumps_about_is_marked_as_wrong():
    """It ends with 3 MN."""
    scenario = read_scenario(None, ("master.algorithm=gauss_seidel", "master.step=5e-5"))
    assert "jumps about from step to step" in run_passage(scenario).attrs["unreliable"]


def test_isolated_fmus_give_the_same_passage_bit_for_bit():
    scenario = read_scenario(None, ("run.approach=0.2", "run.departure=0.1"))
    inside, outside = run_passage(scenario), run_passage(scenario, timeout=60.0)
    assert inside.sizes["time"] > 100
    for name in ("time", "contact_force", "rail_displacement", "gap"):
        assert inside[name].to_numpy().tobytes() == outside[name].to_numpy().tobytes(), name


# figures of the paper, and those of an independent full finite element solution


def test_largest_sleeper_displacement_with_and_without_the_flat(passages):
    """0.45 mm with and 0.39 mm without in the paper, section 4."""
    assert 0.45e-3 <= passages.summary().max_sleeper_displacement <= 0.47e-3
    smooth = passages.summary("flat.shape=none")
    assert 0.39e-3 <= smooth.max_sleeper_displacement <= 0.40e-3


@pytest.mark.parametrize(
    ("overrides", "drop", "state_dependent"),
    [
        ((), single, True),
        (("flat.periodic=true",), periodic, True),
        (("track.ballast=linear",), single, False),
    ],
    ids=["state-dependent", "periodic flat", "linear"],
)
def test_contact_force_is_that_of_the_full_model(passages, overrides, drop, state_dependent):
    """The whole track without modes, by Newmark's rule: 1 % of the load at all times.

    The difference is largest in the vibration after the strike, where a relative error of the
    frequency of 0.05 % adds up; it vanishes with the tolerance of the master.
    """
    full = FullModel(state_dependent=state_dependent)
    expected = full.run(speed=SPEED, drop=drop, stop=17.6, step=2.5e-5)
    passage = passages.dataset(*overrides)
    position = passage["wheel_position"].sel(wheel=1).to_numpy()
    force = passage["contact_force"].sel(wheel=1).to_numpy()
    under_way = expected.position > 13.0  # the full model starts its wheels from rest
    ours = np.interp(expected.position[under_way], position, force)
    difference = np.abs(ours - expected.force[under_way]).max()
    assert difference < 0.01 * STATIC_LOAD
    peak = passages.summary(*overrides).peak_contact_force
    struck = (expected.position > FLAT - 0.1) & (expected.position < FLAT + 0.8)
    assert peak == pytest.approx(expected.force[struck].max(), rel=3e-3)


def test_a_periodic_flat_differs_by_less_than_a_percent_at_40_km_h(passages):
    """The full model says -0.73 %; the vibration of the strike before has all but died out."""
    ratio = (
        passages.summary("flat.periodic=true").peak_contact_force
        / passages.summary().peak_contact_force
    )
    assert ratio == pytest.approx(1.0 - 0.007, abs=0.001)


def test_a_start_near_the_flat_leaves_the_strike_as_it_is(passages):
    near, whole = passages.summary(*NEAR), passages.summary()
    assert near.peak_contact_force == pytest.approx(whole.peak_contact_force, rel=1e-3)
    assert near.max_sleeper_displacement == pytest.approx(whole.max_sleeper_displacement, rel=1e-3)


def test_the_peak_force_is_largest_at_35_km_h_and_higher_than_on_a_linear_track(passages):
    peaks = {
        speed: passages.summary(*NEAR, *speed_key(speed)).peak_contact_force
        for speed in (30, 35, 40, 45)
    }
    assert max(peaks, key=peaks.get) == 35
    linear = passages.summary(*NEAR, "track.ballast=linear", *speed_key(35))
    assert linear.peak_contact_force < 0.8 * peaks[35]
    assert linear.max_sleeper_displacement > 2e-3


def speed_key(speed):
    return () if speed == 40 else (f"vehicle.speed_kmh={speed}",)


@pytest.mark.slow
def test_peak_forces_over_all_speeds(passages):
    speeds = range(10, 101, 5)
    for ballast in ("state_dependent", "linear"):
        peaks = {
            speed: passages.summary(
                f"vehicle.speed_kmh={speed}", f"track.ballast={ballast}"
            ).peak_contact_force
            for speed in speeds
        }
        assert (max(peaks, key=peaks.get) == 35) == (ballast == "state_dependent")


# the command


MEASURED = """
import atexit, sys, time
from pathlib import Path
from railcosim.cli import main
def report():
    status = Path("/proc/self/status").read_text()
    kilobytes = status.split("VmHWM:")[1].split()[0]
    print("used", kilobytes, time.process_time(), file=sys.stderr)
atexit.register(report)
main()
"""


@pytest.mark.skipif(sys.platform != "linux", reason="reads the peak memory from /proc")
def test_the_command_needs_little_time_and_memory(tmp_path):
    """15 s and 500 MB at most; processor time, the best of three where the machine is busy."""
    files = [tmp_path / "passage.nc", tmp_path / "passage.png"]
    options = ["run", "--json", "--output", str(files[0]), "--plot", str(files[1])]
    command = [sys.executable, "-c", MEASURED, *options]
    durations = []
    while len(durations) < 3 and min(durations, default=inf) >= 15.0:
        answer = subprocess.run(command, check=True, capture_output=True, text=True)
        kilobytes, seconds = map(float, answer.stderr.split("used")[-1].split())
        durations.append(seconds)
    numbers = json.loads(answer.stdout)
    assert 0.45e-3 <= numbers["max_sleeper_displacement"] <= 0.47e-3
    assert min(durations) < 15.0
    assert kilobytes < 500_000
    assert all(file.stat().st_size > 1e4 for file in files)
