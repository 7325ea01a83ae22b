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


def run(restitution, stop, recorder):
    # A user who expects bounces of a tenth of a second asks for no more than 20 switches in 10 ms;
    # an impact is two, since the height leaves the side of its first switch at once.
    settings = MasterSettings(tolerance=1e-4, max_step=0.05, max_switches=20, switch_window=1e-2)
    system = System([RigidBall(restitution)], [])
    return Master(system, settings, events=["ball.height"], observers=[recorder]).run(0.0, stop)


@pytest.mark.parametrize("restitution", [0.7, 0.8, 0.9])
def test_impacts_without_end_end_the_run_close_to_where_they_accumulate(restitution):
    accumulation = first_impact * (1.0 + restitution) / (1.0 - restitution)
    recorder = Recorder()
    with pytest.raises(ZenoError, match=r"ball\.height and others switched 21 times") as caught:
        run(restitution, 2.0 * accumulation, recorder)
    time = float(re.search(r"up to t = (\S+) s", str(caught.value))[1])
    # Eleven impacts within the window: the last of them is the window times 1 / (q^-10 - 1) before
    # the end, or one impact later, since impacts do not begin with the window.
    latest = 1e-2 / (restitution**-10 - 1.0)
    assert restitution * latest - 1e-6 <= accumulation - time <= latest + 1e-6
    assert recorder["ball.height"].min() > -1e-9


@pytest.mark.parametrize("restitution", [0.7, 0.9])
def test_impacts_come_at_the_times_of_the_closed_form(restitution):
    count = 8
    bounces = 2.0 * restitution ** np.arange(1, count)
    exact = first_impact * np.cumsum([1.0, *bounces])
    outcome = run(restitution, float(exact[-1]) + 1e-3, Recorder())
    impacts = np.array([item.time for item in outcome.switches if not item.positive])
    # Each landing is early or late by 1e-9 s at most, and so are those after it.
    assert impacts == pytest.approx(exact, abs=count * 2e-9)
