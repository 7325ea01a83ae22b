"""States of the dynamic track: restored bit for bit, and left alone by what is refused."""

import numpy as np
import pytest

from track_fmu.ballast import PolynomialBallast
from track_fmu.track_model import TrackModel, TrackOptions

from .reference import STATIC_LOAD, one_wheel


def test_restored_states_go_on_bit_for_bit(table1):
    model = TrackModel(table1.reduced, TrackOptions(gauges=(16.25,)), ballast=PolynomialBallast())
    positions, forces = np.array([16.0, 14.2]), np.array([STATIC_LOAD, STATIC_LOAD])
    model.start(positions, forces)
    model.step(1e-4, positions + 1e-3, 1.1 * forces)
    saved = model.state
    model.step(2e-4, positions + 3e-3, 1.2 * forces)
    end, seen = model.state, model.observe().gauge_moment
    model.step(5e-4, positions + 8e-3, 0.2 * forces)  # somewhere else
    model.state = saved
    model.step(2e-4, positions + 3e-3, 1.5 * forces)  # a first try
    model.state = saved
    model.step(2e-4, positions + 3e-3, 1.2 * forces)
    assert np.array_equal(model.state, end)
    assert np.array_equal(model.observe().gauge_moment, seen)


def test_two_instances_on_one_track_do_not_meet(table1):
    def make():
        model = TrackModel(table1.reduced, TrackOptions(wheels=1), ballast=PolynomialBallast())
        model.start(np.array([16.0]), np.array([STATIC_LOAD]))
        return model

    def run(models, count):
        for k in range(1, count + 1):
            for i, model in enumerate(models):
                load = STATIC_LOAD * (1 + 0.1 * i * np.sin(k))
                model.step(1e-4, np.array([16.0 + 1e-3 * k]), np.array([load]))
        return [model.state for model in models]

    together = run([make(), make()], 20)
    alone = run([make()], 20)
    assert np.array_equal(together[0], alone[0])
    assert not np.array_equal(together[1], alone[0])


# refusals


@pytest.mark.parametrize(
    ("step", "position", "force", "sentence"),
    [
        (1e-4, 33.0, 1.0, "position 33.0 m lies outside the track of 0 to 32.5 m"),
        (1e-4, float("nan"), 1.0, "position nan m lies outside"),
        (1e-4, 16.0, float("inf"), "contact force inf N of wheel 1"),
        (0.0, 16.0, 1.0, "step size 0.0 s must be greater than 0"),
    ],
)
def test_wrong_steps_are_refused_and_change_nothing(table1, step, position, force, sentence):
    model = one_wheel(table1)
    model.start(np.array([16.0]), np.array([1.0]))
    before = model.state
    with pytest.raises(ValueError, match=sentence):
        model.step(step, np.array([position]), np.array([force]))
    assert np.array_equal(model.state, before)


def test_forces_that_do_not_converge_are_an_error(table1):
    stiff = PolynomialBallast(alpha=1e19, beta=0.0, delta=0.0)
    model = one_wheel(table1, ballast=stiff)
    model.start(np.array([16.25]), np.array([1.0]))
    before = model.state
    with pytest.raises(RuntimeError, match="did not converge"):
        model.step(5e-3, np.array([16.25]), np.array([1e6]))
    assert np.array_equal(model.state, before)


def test_states_of_another_track_are_refused(table1, short):
    with pytest.raises(ValueError, match="does not fit this track"):
        one_wheel(table1).state = one_wheel(short).state
