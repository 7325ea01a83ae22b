"""Wheel masses under given contact forces, against closed forms."""

from itertools import pairwise

import numpy as np
import pytest

from vehicle_fmu.masses import Masses, MassesParameters
from vehicle_fmu.speed import ConstantSpeed

MASS, LOAD, SPEED = 592.5, 117_720.0, 10.0


def masses(**values):
    model = Masses(MassesParameters(**values), speed=ConstantSpeed(speed=SPEED))
    model.initialise(0.0, np.full(len(model.parameters.offsets), LOAD))
    return model


def test_wheels_run_behind_the_first_in_any_number_of_bogies():
    model = masses(offsets=(0.0, 1.8, 9.0, 10.8), initial_position=20.0)
    assert model.position == pytest.approx([20.0, 18.2, 11.0, 9.2], rel=1e-15)
    for k in range(1000):
        model.step(1e-3 * k, 1e-3, np.full(4, LOAD), linear=False)
    assert model.position == pytest.approx([30.0, 28.2, 21.0, 19.2], rel=1e-12)
    assert (model.displacement == 0.0).all()
    assert (model.velocity == 0.0).all()


def test_a_force_on_straight_lines_is_integrated_exactly():
    """F = P + r t gives z = -r t^3 / 6 m, whatever the steps."""
    model, rate, time = masses(offsets=(0.0,)), 3e6, 0.0
    for size in (1e-4, 7e-3, 3e-5, 2e-3):
        model.step(time, size, np.array([LOAD + rate * (time + size)]), linear=True)
        time += size
    assert model.displacement[0] == pytest.approx(-rate * time**3 / 6.0 / MASS, rel=1e-12)
    assert model.velocity[0] == pytest.approx(-rate * time**2 / 2.0 / MASS, rel=1e-12)


def smooth_force(t):
    return LOAD * (1.0 + np.sin(300.0 * t))


def exact(t):
    """Displacement and velocity under `smooth_force` from rest."""
    scale = LOAD / MASS / 300.0
    return scale * (np.sin(300.0 * t) / 300.0 - t), scale * (np.cos(300.0 * t) - 1.0)


def error(step, *, linear):
    model, worst = masses(offsets=(0.0,)), np.zeros(2)
    for k in range(round(0.03 / step)):
        time = step * (k + 1)
        given = smooth_force(time if linear else step * k)
        model.step(step * k, step, np.array([given]), linear=linear)
        seen = np.array([model.displacement[0], model.velocity[0]])
        worst = np.maximum(worst, np.abs(seen - exact(time)))
    return worst


@pytest.mark.parametrize("linear", [True, False])
def test_displacement_and_velocity_are_of_second_order(linear):
    coarse, fine = error(2e-4, linear=linear), error(1e-4, linear=linear)
    assert np.log2(coarse / fine) == pytest.approx([2.0, 2.0], abs=0.1)


def test_what_was_guessed_is_replaced_by_what_was_known_later():
    """Forces known at the start of a step only: the impulse still is that of the straight lines."""
    told_late, told_early = masses(offsets=(0.0,)), masses(offsets=(0.0,))
    forces = LOAD * np.array([1.0, 1.5, 0.0, 0.0, 2.0, 1.0])
    for k, (now, following) in enumerate(pairwise(forces)):
        told_late.step(1e-3 * k, 1e-3, np.array([now]), linear=False)
        told_early.step(1e-3 * k, 1e-3, np.array([following]), linear=True)
    # the next force corrects the last step; a step of almost no size shows it
    told_late.step(5e-3, 1e-15, forces[-1:], linear=False)
    assert told_late.velocity[0] == pytest.approx(told_early.velocity[0], rel=1e-9)
    assert told_late.displacement[0] == pytest.approx(told_early.displacement[0], rel=1e-9)


def test_a_restored_state_repeats_itself_bit_for_bit():
    def go_on(model):
        for k in range(5, 10):
            model.step(1e-4 * k, 1e-4, np.array([LOAD * 0.1 * k, 0.0]), linear=False)
        return model.displacement.tobytes() + model.velocity.tobytes() + model.position.tobytes()

    model, other = masses(), masses(initial_position=12.7)
    for k in range(5):
        model.step(1e-4 * k, 1e-4, np.array([LOAD * 0.3 * k, LOAD]), linear=False)
    saved = model.state
    expected = go_on(model)
    model.state = saved
    other.state = saved
    assert go_on(model) == go_on(other) == expected


@pytest.mark.parametrize(
    ("time", "size", "force", "sentence"),
    [
        (1.0, 1e-3, LOAD, "steps must join"),
        (0.0, 0.0, LOAD, "step size is 0 s"),
        (0.0, 1e-3, np.nan, "contact force of wheel 1 is nan N"),
        (0.0, 1e154, 1e30, "drives the wheel to -inf m"),
        (0.0, np.inf, LOAD, "and so must be its end"),
    ],
)
def test_impossible_steps_are_refused(time, size, force, sentence):
    model = masses(offsets=(0.0,))
    before = model.state.tobytes()
    with pytest.raises(ValueError, match=sentence):
        model.step(time, size, np.array([force]), linear=False)
    assert model.state.tobytes() == before


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"offsets": ()}, "of wheel 1, must be 0"),
        ({"offsets": (0.5, 1.0)}, "of wheel 1, must be 0"),
        ({"offsets": (0.0, np.inf)}, "offset of wheel 2"),
        ({"wheel_mass": 0.0}, "wheel_mass is 0 kg"),
        ({"static_wheel_load": -1.0}, "static_wheel_load is -1 N"),
        ({"initial_position": np.nan}, "initial_position is nan m"),
    ],
)
def test_impossible_parameters_are_refused(values, sentence):
    with pytest.raises(ValueError, match=sentence):
        MassesParameters(**values)
