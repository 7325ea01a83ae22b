"""A mass falls on a spring that cannot pull: switches located, energy kept."""

from math import cos, pi, sin, sqrt

import numpy as np
import pytest
from fake_participants import drop
from scipy.optimize import brentq

from orchestrator import Master, MasterSettings, Newton, Recorder

mass, stiffness, gravity, height = 1.0, 1e4, 10.0, 0.1
switch_count = 20


def exact_switches():
    omega, sag = sqrt(stiffness / mass), mass * gravity / stiffness
    speed = sqrt(2.0 * gravity * height)

    def displacement(t):
        return sag * (1.0 - cos(omega * t)) + speed / omega * sin(omega * t)

    contact = brentq(displacement, 0.9 * pi / omega, 1.5 * pi / omega, xtol=1e-15)
    flight = 2.0 * speed / gravity
    times = [speed / gravity]
    while len(times) < switch_count:
        times.append(times[-1] + (contact if len(times) % 2 else flight))
    return np.array(times)


def run(tolerance):
    recorder = Recorder()
    settings = MasterSettings(tolerance=tolerance, max_step=0.02, initial_step=1e-4, min_step=1e-9)
    master = Master(drop(), settings, events=["ball.gap"], observers=[recorder])
    outcome = master.run(0.0, float(exact_switches()[-1]) + 0.05)
    x, v = recorder["ball.displacement"], recorder["ball.velocity"]
    energy = 0.5 * mass * v**2 - mass * gravity * x + 0.5 * stiffness * np.maximum(x, 0.0) ** 2
    return outcome, np.abs(energy / energy[0] - 1.0).max()


@pytest.fixture(scope="module")
def runs():
    return [run(tolerance) for tolerance in (1e-2, 1e-3, 1e-4)]


def test_every_switch_is_found_once_and_on_time(runs):
    for outcome, _ in runs:
        assert outcome.statistics.switches == switch_count
        assert [item.positive for item in outcome.switches] == [False, True] * (switch_count // 2)
    errors = [
        np.abs(np.array([item.time for item in outcome.switches]) - exact_switches()).max()
        for outcome, _ in runs
    ]
    # In proportion to the tolerance, within a factor that step rounding can explain.
    assert np.array(errors[:-1]) / np.array(errors[1:]) == pytest.approx([10, 10], rel=0.5)
    assert errors[-1] < 1e-4


def test_energy_drift_shrinks_in_proportion_to_the_tolerance(runs):
    drifts = np.array([drift for _, drift in runs])
    assert drifts[:-1] / drifts[1:] == pytest.approx([10, 10], rel=0.5)
    assert drifts[-1] < 1e-4


def test_locating_a_switch_takes_few_attempts(runs):
    for outcome, _ in runs:
        # One accepted attempt lands on each switch, the rejected ones come on top.
        assert outcome.statistics.rejected["event"] / switch_count + 1.0 <= 5.0


def test_accepted_points_lie_on_the_switches():
    recorder = Recorder(["ball.gap"])
    settings = MasterSettings(tolerance=1e-3, max_step=0.02, initial_step=1e-4, min_step=1e-9)
    master = Master(drop(), settings, events=["ball.gap"], observers=[recorder])
    outcome = master.run(0.0, 0.5)
    gaps = recorder["ball.gap"][np.isin(recorder.time, [item.time for item in outcome.switches])]
    assert gaps.size == outcome.statistics.switches > 0
    assert np.abs(gaps).max() <= 1e-10


def test_nothing_is_predicted_across_a_switch():
    settings = MasterSettings(tolerance=1e-3, max_step=0.02, initial_step=1e-4, min_step=1e-9)
    outcome = Master(drop(), settings, events=["ball.gap"]).run(0.0, 0.5)
    log = outcome.step_log
    first = [np.argmax(log["time"] == switch.time) for switch in outcome.switches]
    assert len(first) > 0
    # All others but the very first attempt are compared with the straight line before them.
    assert np.isnan(log["error_norm"][first]).all()
    assert np.isfinite(log["error_norm"][1 : first[0]]).all()


def test_without_located_switches_the_energy_is_worse():
    recorder = Recorder()
    settings = MasterSettings(tolerance=None, fixed_step=2e-3)
    Master(drop(), settings, observers=[recorder]).run(0.0, 2.0)
    plain = Recorder()
    Master(drop(), settings, events=["ball.gap"], observers=[plain]).run(0.0, 2.0)

    def drift(history):
        x, v = history["ball.displacement"], history["ball.velocity"]
        energy = 0.5 * v**2 - gravity * x + 0.5 * stiffness * np.maximum(x, 0.0) ** 2
        return np.abs(energy - energy[0]).max()

    assert drift(plain) < 0.5 * drift(recorder)


class Forgetful:
    """Newton's method that counts how often it is told to forget."""

    def __init__(self):
        self.newton = Newton(tolerance=1e-7, max_iterations=20)
        self.count = 0

    def __getattr__(self, name):
        return getattr(self.newton, name)

    def couple(self, blocks):
        coupling = self.newton.couple(blocks)
        plain = coupling.forget

        def forget():
            self.count += 1
            plain()

        coupling.forget = forget
        return coupling


def test_jacobians_are_forgotten_at_every_switch():
    settings = MasterSettings(tolerance=1e-3, max_step=0.02, initial_step=1e-4, min_step=1e-9)
    algorithm = Forgetful()
    outcome = Master(drop(), settings, algorithm=algorithm, events=["ball.gap"]).run(0.0, 0.5)
    assert algorithm.count == outcome.statistics.switches > 0
