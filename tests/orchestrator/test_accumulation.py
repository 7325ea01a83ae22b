"""Which switches accumulate: those of a rigid ball do, of a soft one and of a relay do not."""

from itertools import accumulate
from math import pi

import numpy as np
import pytest
from fake_participants import Fake
from scipy.linalg import expm

from orchestrator import Master, MasterSettings, System
from orchestrator.accumulation import GeometricIntervals

gravity, height, damping = 10.0, 0.2, 0.05


def expected(intervals, start=0.0):
    """Return the first accumulation time expected, with the number of intervals it took."""
    series = GeometricIntervals(1e-3)
    for count, time in enumerate(accumulate(intervals, initial=start)):
        end = series.add(time)
        if end is not None:
            return end, count
    return None, len(intervals)


@pytest.mark.parametrize("ratio", [0.05, 0.2, 0.5, 0.9, 0.99])
def test_a_geometric_series_ends_where_its_sum_says(ratio):
    end, count = expected(ratio ** np.arange(2000.0), start=5.0)
    assert end == pytest.approx(5.0 + 1.0 / (1.0 - ratio), rel=1e-9)
    # The rest over what went before is q^n / (1 - q^n); four intervals at least.
    assert count == max(4, np.ceil(np.log(1e-3 / 1.001) / np.log(ratio)))


def test_what_came_before_the_series_does_not_count():
    before = [0.3, 0.1, 0.2, 1.0, 0.4]
    end, _ = expected([*before, *0.5 ** np.arange(60.0)])
    assert end == pytest.approx(sum(before) + 2.0, rel=1e-9)


@pytest.mark.parametrize(
    "intervals",
    [
        np.full(1000, 1e-3),
        0.9 ** np.arange(300.0) + 1e-4,
        1.0 / np.arange(1.0, 1000.0),
        np.tile([0.5, 0.25, 0.125, 0.0625], 200),
        np.random.default_rng(1).uniform(0.0, 1.0, 100_000),
    ],
    ids=["constant", "down to a contact", "harmonic", "bursts", "random"],
)
def test_other_intervals_do_not_accumulate(intervals):
    assert expected(intervals) == (None, len(intervals))


class SoftBall(Fake):
    """Falls on a damped spring that acts below zero, both solved exactly in time."""

    outputs = ("height",)

    def __init__(self, contact_time):
        super().__init__("ball")
        omega = pi / contact_time
        fall = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, -gravity], [0.0, 0.0, 0.0]])
        press = fall + np.array([[0.0] * 3, [-(omega**2), -2.0 * damping * omega, 0.0], [0.0] * 3])
        self.laws = fall, press
        self.powers = {}

    def initial_state(self):
        return height, 0.0

    def initial_outputs(self, _values):
        return self.state[:1]

    def advance(self, over):
        y, v = self.state
        law = int(y < -1e-10 or (y <= 1e-10 and v < 0.0))
        key = law, over.step_size
        if key not in self.powers:
            self.powers[key] = expm(self.laws[law] * over.step_size)
        y, v, _ = self.powers[key] @ (y, v, 1.0)
        self.state = float(y), float(v)
        return self.state[:1]


@pytest.mark.parametrize("contact_time", [3e-2, 1e-3, 1e-4])
def test_a_soft_ball_comes_to_rest(contact_time):
    # The first step in contact is a tenth of this at most: half of a contact.
    settings = MasterSettings(tolerance=1e-4, max_step=5.0 * contact_time)
    outcome = Master(System([SoftBall(contact_time)], []), settings, events=["ball.height"]).run(
        0.0, 6.0
    )
    # It leaves the spring for the last time when what it brings is used up within a contact.
    assert outcome.end_time == 6.0
    impacts = [item.time for item in outcome.switches if not item.positive]
    assert len(impacts) > 5
    assert impacts[-1] < 5.0
    assert impacts[-1] - impacts[-2] < 30.0 * contact_time


class Relay(Fake):
    """Switches its drive where its output leaves a band: chatters at a constant rate."""

    outputs = ("upper", "lower")

    def initial_state(self):
        return 0.5, -1.0

    def initial_outputs(self, _values):
        return 0.5, 0.5

    def advance(self, over):
        x, drive = self.state
        if x <= 1e-9:
            drive = 1.0
        elif x >= 1.0 - 1e-9:
            drive = -1.0
        x += 100.0 * drive * over.step_size
        self.state = x, drive
        return 1.0 - x, x


def test_a_relay_chatters_on():
    events = ["relay.upper", "relay.lower"]
    settings = MasterSettings(tolerance=None, fixed_step=4e-3)
    outcome = Master(System([Relay("relay")], []), settings, events=events).run(0.0, 4.0)
    assert outcome.statistics.switches > 4.0 * 100.0
