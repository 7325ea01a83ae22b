"""The suspended vehicle on either side of the contacts: limits, equilibrium, repeatability."""

import numpy as np
import pytest

from vehicle_fmu.bodies import observe_bodies
from vehicle_fmu.masses import Masses, MassesParameters
from vehicle_fmu.parameters import FlatParameters, VehicleParameters
from vehicle_fmu.speed import ConstantSpeed
from vehicle_fmu.suspended_masses import SuspendedMasses
from vehicle_fmu.suspended_vehicle import SuspendedVehicle
from vehicle_fmu.vehicle_model import VehicleModel

from .suspended import LOAD, OFFSETS, TREAD, WHEEL, coach

SPEED = ConstantSpeed(speed=25.0)
SOFT = {"primary": (0.0, 0.0), "secondary": (0.0, 0.0)}
WHEELS = {"offsets": OFFSETS, "wheel_mass": WHEEL, "static_wheel_load": LOAD}


def vehicle(suspension, *, substep=2e-5, **options):
    parameters = VehicleParameters(initial_position=0.0, substep=substep, **WHEELS)
    rolling = {"flat": FlatParameters(position=0.5), "speed": SPEED, **options}
    if suspension is None:
        model = VehicleModel(parameters, **rolling)
    else:
        model = SuspendedVehicle(parameters, suspension=suspension, **rolling)
    model.initialise(0.0, np.full(4, 1e-3))
    return model


def masses(suspension):
    parameters = MassesParameters(**WHEELS)
    model = (
        Masses(parameters, speed=SPEED)
        if suspension is None
        else SuspendedMasses(parameters, speed=SPEED, suspension=suspension)
    )
    model.initialise(0.0, np.full(4, LOAD))
    return model


def roll(model, steps, step=2e-4):
    forces = []
    for k in range(steps):
        rail = 1e-3 + 1e-4 * np.sin(50.0 * step * (k + 1)) * np.arange(1, 5)
        model.step(step * k, step, rail, linear=True)
        forces.append(model.contact_force)
    return np.array(forces)


def press(model, steps, *, linear=True, step=1e-4):
    for k in range(steps):
        time = step * (k + linear)
        forces = LOAD * (1.0 + 0.3 * np.sin(300.0 * time + np.arange(4)))
        model.step(step * k, step, forces, linear=linear)
    return model.displacement


def test_without_springs_the_wheels_are_the_moving_masses():
    """The method is then the same: rounding alone."""
    free, rigid = roll(vehicle(coach(**SOFT)), 200), roll(vehicle(None), 200)
    assert np.ptp(rigid) > 0.5 * LOAD
    np.testing.assert_allclose(free, rigid, rtol=0.0, atol=1e-9 * LOAD)
    for linear in (True, False):
        coupled, single = (
            press(masses(suspension), 200, linear=linear) for suspension in (coach(**SOFT), None)
        )
        np.testing.assert_allclose(coupled, single, rtol=0.0, atol=1e-12 * np.abs(single).max())


def test_a_stiff_tread_is_a_rigid_wheel():
    flexible = coach(tread=(300.0, 3e11, 1e6), **SOFT)
    soft = roll(vehicle(flexible), 100, step=2e-6)
    rigid = roll(vehicle(None), 100, step=2e-6)
    assert soft == pytest.approx(rigid, rel=1e-3)


def test_equilibrium_stays_where_the_rail_is_smooth():
    model = vehicle(coach(tread=TREAD), flat=FlatParameters(shape="none"))
    for k in range(50):
        model.step(1e-3 * k, 1e-3, np.full(4, 1e-3), linear=True)
    assert model.contact_force == pytest.approx([LOAD] * 4, rel=1e-9)
    seen = observe_bodies(model)
    assert abs(seen["car_displacement"][0]) < 1e-12
    assert seen["primary_force"] == pytest.approx([LOAD - WHEEL * 9.81] * 4, rel=1e-9)


def test_the_bodies_follow_long_waves_and_not_short_ones():
    """A flat's strike does not reach the car body; a rail that sags slowly takes it along."""
    struck = vehicle(coach())
    roll(struck, 200)
    seen = observe_bodies(struck)
    assert abs(seen["car_displacement"][0]) < 1e-4
    sagging = vehicle(coach(), flat=FlatParameters(shape="none"), substep=1e-4)
    for k in range(1000):  # over a period of the car body's bounce, and once more
        rail = 1e-3 + 10e-3 * min(1.0, 2e-3 * (k + 1))
        sagging.step(2e-3 * k, 2e-3, np.full(4, rail), linear=True)
    seen = observe_bodies(sagging)
    assert seen["car_displacement"][0] == pytest.approx(10e-3, rel=5e-2)
    assert seen["bogie_displacement"] == pytest.approx([10e-3] * 2, rel=5e-2)


@pytest.mark.parametrize("make", [vehicle, masses])
def test_a_restored_state_repeats_itself_bit_for_bit(make):
    go_on = roll if make is vehicle else press
    one, other = make(coach(tread=TREAD)), make(coach(tread=TREAD))
    go_on(one, 7)
    saved = one.state
    time = float(saved[1])
    expected = [step_from(one, time, make)]
    one.state = saved
    other.state = saved
    assert expected == [step_from(one, time, make)] == [step_from(other, time, make)]


def step_from(model, time, make):
    model.step(time, 3e-4, np.full(4, 1e-3 if make is vehicle else LOAD), linear=False)
    return b"".join(values.tobytes() for values in observe_bodies(model).values())


@pytest.mark.parametrize("make", [vehicle, masses])
def test_impossible_steps_leave_the_model_as_it_was(make):
    model = make(coach())
    before = model.state.tobytes()
    huge = -1e300 if make is vehicle else 1e308
    with pytest.raises(ValueError, match=r"shorter step|out of the range of numbers"):
        model.step(0.0, 1e-4 if make is vehicle else 1e-2, np.full(4, huge), linear=True)
    assert model.state.tobytes() == before
    with pytest.raises(ValueError, match="has shape"):
        model.state = model.state[:-1]


def test_both_sides_of_the_contacts_move_alike():
    """The contact forces of the one, given to the other, move its bodies in the same way."""
    one, other = vehicle(coach(tread=TREAD)), masses(coach(tread=TREAD))
    step = 2e-5
    for k in range(1500):
        one.step(step * k, step, np.full(4, 1e-3), linear=True)
        other.step(step * k, step, one.contact_force, linear=True)
    ours, theirs = observe_bodies(one), observe_bodies(other)
    scale = np.abs(ours["bogie_displacement"]).max()
    assert scale > 1e-5
    # forces on straight lines over 20 us, under a tread that vibrates at 330 Hz
    assert theirs["bogie_displacement"] == pytest.approx(
        ours["bogie_displacement"], abs=1e-3 * scale
    )
