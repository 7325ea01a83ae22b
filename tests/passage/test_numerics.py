"""The passage's numbers: finer settings, conservation, repeatability."""

import numpy as np
import pytest

from orchestrator import Master, Recorder
from railcosim.builds import build_for
from railcosim.coupled_system import fmu_sources, indicators, join, master_settings
from railcosim.motion import speed_law
from railcosim.scenario_file import read_scenario
from tests.throwing import Throwing

from .reference_case import NEAR, SPEED, STATIC_LOAD

pytestmark = pytest.mark.xdist_group("passage")  # they share runs


@pytest.mark.parametrize(
    "override",
    [
        "master.tolerance=1e-3",
        "master.step=1e-4",
        "master.coupling_tolerance=1e-7",
        "track.mode_pairs=300",
        "track.supports_per_wheel=12",
    ],
)
def test_finer_settings_change_the_peak_by_less_than_three_in_a_thousand(passages, override):
    finer = passages.summary(*NEAR, override)
    assert finer.peak_contact_force == pytest.approx(
        passages.summary(*NEAR).peak_contact_force, rel=3e-3
    )


def test_impulse_of_the_contact_force_is_that_of_the_static_load(passages):
    """m dv/dt = P - F over the whole run, for both wheels."""
    passage = passages.dataset()
    time = passage["time"].to_numpy()
    for wheel in (1, 2):
        force = passage["contact_force"].sel(wheel=wheel).to_numpy()
        velocity = passage["wheel_velocity"].sel(wheel=wheel).to_numpy()
        impulse = np.trapezoid(STATIC_LOAD - force, time)
        change = 592.5 * (velocity[-1] - velocity[0])
        # what the trapezoidal rule makes of steps up to 200 us
        assert impulse == pytest.approx(change, abs=2e-5 * STATIC_LOAD * time[-1])
    smooth = passages.dataset("flat.shape=none")
    mean = np.trapezoid(smooth["contact_force"].sel(wheel=1), smooth["time"]) / smooth["time"][-1]
    assert float(mean) == pytest.approx(STATIC_LOAD, rel=2e-3)


def test_a_fresh_flat_loses_contact_and_strikes(passages):
    """Drop, loss, impact: the switches of contact are landed on."""
    passage = passages.dataset("flat.shape=chord")
    summary = passages.summary("flat.shape=chord")
    assert summary.min_contact_force == 0.0
    assert summary.loss_of_contact_time > 0.01
    assert summary.steps.rejected["event"] > 0
    assert summary.peak_contact_force > 400e3
    gap = passage["gap"].sel(wheel=1).to_numpy()
    crossing = np.flatnonzero(np.diff(np.sign(gap)) != 0)
    assert len(crossing) >= 4
    # one of the two points beside a change of side lies on the switch
    landed = np.minimum(np.abs(gap[crossing]), np.abs(gap[crossing + 1]))
    assert landed.max() < 1e-9


def recorded(overrides, share):
    scenario = read_scenario(None, overrides)
    law = speed_law(scenario.vehicle)
    settings = master_settings(scenario)
    stop = scenario.distance / SPEED
    controller = Throwing(settings.make_controller(stop), share, seed=3)
    recorder = Recorder(
        [f"vehicle.wheel[{i}].contact_force" for i in (1, 2)]
        + ["track.wheel[1].rail_displacement", "track.gauge[1].bending_moment"]
    )
    Master(
        join(fmu_sources(scenario, build_for(scenario), law), scenario),
        settings,
        controller=controller,
        events=indicators(2),
        observers=[recorder],
    ).run(0.0, stop)
    return recorder, controller.thrown


def test_attempts_thrown_away_at_random_leave_no_trace():
    """A fresh flat, so that the run has switches; 0.3 m before it to 0.4 m after."""
    overrides = ("run.approach=0.3", "run.departure=0.4", "flat.shape=chord")
    undisturbed, none = recorded(overrides, 0.0)
    disturbed, thrown = recorded(overrides, 0.3)
    assert none == 0
    assert thrown > 100
    assert undisturbed.time.tobytes() == disturbed.time.tobytes()
    assert undisturbed.values.tobytes() == disturbed.values.tobytes()


def test_two_runs_are_the_same_bit_for_bit(passages):
    key = ("run.approach=0.2", "run.departure=0.2")
    first = passages.dataset(*key)
    again = passages.__class__().dataset(*key)
    for name in ("contact_force", "rail_displacement", "sleeper_displacement"):
        assert first[name].to_numpy().tobytes() == again[name].to_numpy().tobytes()
