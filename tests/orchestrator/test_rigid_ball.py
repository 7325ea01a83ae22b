"""A rigid ball bounces lower and lower: its impacts accumulate at a time known in closed form."""

import re
from math import sqrt

import numpy as np
import pytest
from fake_participants import Fake

from orchestrator import Master, MasterSettings, Recorder, System, ZenoError

gravity, height = 10.0, 0.2
first_impact = sqrt(2.0 * height / gravity)


class RigidBall(Fake):
    """Falls freely; where a step begins on the ground, its speed is reversed and reduced."""

    outputs = ("height", "speed")

    def __init__(self, restitution):
        super().__init__("ball")
        self.restitution = restitution

    def initial_state(self):
        return height, 0.0

    def initial_outputs(self, _values):
        return self.state

    def advance(self, over):
        y, v = self.state
        if y <= 1e-9 and v < 0.0:
            v = -self.restitution * v
        h = over.step_size
        self.state = y + v * h - 0.5 * gravity * h**2, v - gravity * h
        return self.state


def run(restitution, stop, recorder, **settings):
    chosen = MasterSettings(**({"tolerance": 1e-4} | settings))
    system = System([RigidBall(restitution)], [])
    return Master(system, chosen, events=["ball.height"], observers=[recorder]).run(0.0, stop)


def accumulation(restitution):
    return first_impact * (1.0 + restitution) / (1.0 - restitution)


def numbers(pattern, error):
    return [float(number) for number in re.search(pattern, str(error)).groups()]


@pytest.mark.parametrize("restitution", [0.1, 0.3, 0.5, 0.7, 0.8, 0.9, 0.97])
def test_default_settings_expect_the_accumulation_of_impacts(restitution):
    exact = accumulation(restitution)
    recorder = Recorder()
    with pytest.raises(ZenoError, match=r"^ball\.height .* come to rest there") as caught:
        run(restitution, 2.0 * exact, recorder)
    time, expected = numbers(r"before t = (\S+) s, which accumulate at t = (\S+) s", caught.value)
    # At least four intervals, and the rest of the series is a thousandth of what it took so far.
    assert 0.0 < expected - time <= 1e-3 * exact
    # The ratio is known from `count` of them, each of which may be off by twice the tolerance of
    # a landing, 1e-9 s; the rest of the series, q / (1 - q), passes that on by 1 / (1 - q)^2. The
    # message has nine digits.
    count = sum(not item.positive for item in caught.value.outcome.switches) - 2
    error = 2e-9 / (count * (1.0 - restitution) ** 2)
    assert expected == pytest.approx(exact, abs=error + 5e-9 * max(1.0, exact))
    # It has not fallen through the ground.
    assert recorder["ball.height"].min() > -1e-9


def test_a_run_that_stops_before_the_accumulation_is_done():
    exact = accumulation(0.7)
    # The rest is first below a thousandth 0.7 ms before.
    outcome = run(0.7, exact - 1e-4, Recorder())
    assert outcome.end_time == exact - 1e-4
    assert exact - outcome.switches[-1].time < 2e-4


@pytest.mark.parametrize("restitution", [0.7, 0.8, 0.9])
def test_the_window_ends_impacts_that_are_not_expected_to_accumulate(restitution):
    # A user who expects bounces of a tenth of a second asks for no more than 20 switches in 10 ms;
    # an impact is two, since the height leaves the side of its first switch at once.
    window = {"max_switches": 20, "switch_window": 1e-2, "accumulation_share": 1e-12}
    exact = accumulation(restitution)
    recorder = Recorder()
    with pytest.raises(ZenoError, match=r"ball\.height and others switched 21 times") as caught:
        run(restitution, 2.0 * exact, recorder, max_step=0.05, **window)
    (time,) = numbers(r"up to t = (\S+) s", caught.value)
    # Eleven impacts within the window: the last of them is the window times 1 / (q^-10 - 1) before
    # the end, or one impact later, since impacts do not begin with the window.
    latest = 1e-2 / (restitution**-10 - 1.0)
    assert restitution * latest - 1e-6 <= exact - time <= latest + 1e-6
    assert recorder["ball.height"].min() > -1e-9


@pytest.mark.parametrize("restitution", [0.7, 0.9])
def test_impacts_come_at_the_times_of_the_closed_form(restitution):
    count = 8
    bounces = 2.0 * restitution ** np.arange(1, count)
    exact = first_impact * np.cumsum([1.0, *bounces])
    outcome = run(restitution, float(exact[-1]) + 1e-3, Recorder(), max_step=0.05)
    impacts = np.array([item.time for item in outcome.switches if not item.positive])
    # Each landing is early or late by 1e-9 s at most, and so are those after it.
    assert impacts == pytest.approx(exact, abs=count * 2e-9)
