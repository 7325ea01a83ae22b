import math

import numpy as np
import pytest

from vehicle_fmu.contact import hertz_compression, hertz_stiffness
from vehicle_fmu.irregularity import RailIrregularity
from vehicle_fmu.parameters import FlatParameters, VehicleParameters
from vehicle_fmu.speed import ConstantSpeed, SpeedTable
from vehicle_fmu.vehicle_model import VehicleModel

P, MASS, C = 117_720.0, 592.5, 9.17e10
SPEED = 40.0 / 3.6
REST = hertz_compression(P, C)


def run(vehicle, end, step, rail=lambda _: 0.0, *, linear=True):
    """Step to `end` with the rail displacement rail(t) under every wheel; return all forces."""
    forces = []
    for k in range(round(end / step)):
        u = np.full(vehicle.parameters.wheels, rail((k + 1) * step))
        vehicle.step(k * step, step, u, linear=linear)
        forces.append(vehicle.contact_force)
    return np.array(forces)


def test_defaults_are_the_demonstration_example():
    # Nielsen & Oscarsson (2004), Table 1: wheelset 1185 kg, axle load 24 t, wheel diameter 0.9 m.
    parameters = VehicleParameters()
    assert parameters.wheel_mass == 1185.0 / 2.0
    assert parameters.static_wheel_load == pytest.approx(24_000.0 * 9.81 / 2.0, rel=1e-15)
    assert parameters.wheel_radius == 0.900 / 2.0
    assert parameters.offsets == (0.0, 1.8)


def test_start_is_static_equilibrium_on_the_displaced_rail(make_vehicle):
    vehicle = make_vehicle()
    rail = np.array([1.2e-3, -0.4e-3])
    vehicle.initialise(2.0, rail)
    np.testing.assert_array_equal(vehicle.position, [12.7, 12.7 - 1.8])
    np.testing.assert_array_equal(vehicle.velocity, [0.0, 0.0])
    # Differences of numbers of 1e-3 m: 1e-19 m of rounding, times 1.5e9 N/m.
    np.testing.assert_allclose(vehicle.contact_force, P, rtol=1e-14)
    np.testing.assert_allclose(vehicle.displacement, rail + REST, rtol=1e-14)
    np.testing.assert_allclose(vehicle.gap, -REST, rtol=1e-14)
    assert vehicle.in_contact.tolist() == [True, True]


def test_start_on_a_flat_and_a_dip_is_in_equilibrium_too(make_vehicle):
    dip = RailIrregularity(position=np.arange(4.0), drop=np.full(4, 2e-3))
    vehicle = make_vehicle(flat=FlatParameters(wheel=2, position=10.9), irregularity=dip)
    np.testing.assert_allclose(vehicle.contact_force, P, rtol=1e-14)
    np.testing.assert_allclose(vehicle.displacement, [REST + 2e-3, REST + 2.9e-3], rtol=1e-14)


def test_static_equilibrium_stays_put_to_rounding(make_vehicle):
    vehicle = make_vehicle()
    rail = np.array([1.2e-3, -0.4e-3])
    vehicle.initialise(0.0, rail)
    for k in range(2000):
        vehicle.step(k * 1e-4, 1e-4, rail, linear=True)
    # Fifty periods of the contact's oscillation about an equilibrium known to rounding; that force
    # error over the impedance sqrt(k m) of 9.4e5 Ns/m is the velocity.
    np.testing.assert_allclose(vehicle.contact_force, P, rtol=1e-13)
    assert np.abs(vehicle.velocity).max() < 1e-13 * P / 9.4e5
    np.testing.assert_allclose(vehicle.position, [12.7 + 0.2 * SPEED, 10.9 + 0.2 * SPEED])


def test_lifted_wheel_falls_freely_and_lands(make_vehicle):
    vehicle = make_vehicle(offsets=(0.0,))
    state = vehicle.state
    state[2] = -1e-3
    vehicle.state = state
    assert vehicle.gap.tolist() == [1e-3]
    time = 2e-3
    vehicle.step(0.0, time, np.zeros(1), linear=True)
    assert vehicle.in_contact.tolist() == [False]
    assert vehicle.contact_force.tolist() == [0.0]
    fallen = 0.5 * P / MASS * time**2
    # Exact for the method: a hundred substeps of rounding at 1e-3 m.
    assert vehicle.gap[0] == pytest.approx(1e-3 - fallen, rel=1e-13)
    vehicle.step(time, time, np.zeros(1), linear=True)
    assert vehicle.in_contact.tolist() == [True]
    assert vehicle.contact_force[0] > P


@pytest.mark.parametrize(("linear", "order"), [(True, 2.0), (False, 1.0)])
def test_order_of_the_coupling_input(make_vehicle, linear, order):
    def rail(t):
        return 3e-5 * (1.0 - math.cos(800.0 * t))

    def forces(step, *, linear):
        vehicle = make_vehicle(offsets=(0.0,), substep=1e-5)
        every = round(2e-4 / step)
        return run(vehicle, 8e-3, step, rail, linear=linear)[every - 1 :: every]

    exact = forces(1e-5, linear=True)
    errors = [abs(forces(step, linear=linear) - exact).max() for step in (2e-4, 1e-4)]
    assert math.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.2)


def test_held_input_acts_from_the_start_of_the_step(make_vehicle):
    vehicle = make_vehicle(offsets=(0.0,))
    k = hertz_stiffness(P, C)
    push, time = 1e-9, 5e-5
    vehicle.step(0.0, time, np.array([push]), linear=False)
    # A step of the rail by u: z = -u (1 - cos(w t)) upwards, to the curvature of Hertz's law.
    expected = push * (1.0 - math.cos(math.sqrt(k / MASS) * time))
    assert vehicle.displacement[0] - REST == pytest.approx(expected, rel=1e-4)


def test_smooth_flat_converges_with_order_four_in_the_substep(make_vehicle):
    # All of the way lies on one long flat, where its shape has every derivative.
    flat = FlatParameters(length=0.5, depth=3e-4, position=12.8)

    def end(substep):
        vehicle = make_vehicle(offsets=(0.0,), flat=flat, substep=substep)
        forces = run(vehicle, 0.02, 4e-4)
        assert forces.min() > 0.0
        return forces

    exact = end(5e-6)
    errors = [np.abs(end(substep) - exact).max() for substep in (2e-4, 1e-4)]
    assert math.log2(errors[0] / errors[1]) == pytest.approx(4.0, abs=0.3)


def test_default_substep_resolves_the_impact_of_a_flat(make_vehicle):
    flat = FlatParameters(position=12.8)
    coarse = run(make_vehicle(offsets=(0.0,), flat=flat), 0.03, 1e-4)
    fine = run(make_vehicle(offsets=(0.0,), flat=flat, substep=1e-6), 0.03, 1e-4)
    assert fine.min() == 0.0
    assert fine.max() > 3.0 * P
    assert np.abs(coarse - fine).max() < 1e-3 * P


@pytest.mark.parametrize("substep", [2e-5, 1e-4 / 3.0, 7e-6])
def test_step_takes_as_many_substeps_as_it_holds(make_vehicle, substep):
    excitation = make_vehicle(substep=substep)._excitation
    for count in range(1, 60):
        for share, expected in ((1.0, count), (0.99, count), (1.01, count + 1)):
            drops = excitation.drops_over_step(0.0, 0.0, share * count * substep)
            assert [len(row) for row in drops] == [2 * expected + 1] * 2


def test_one_step_equals_the_sum_of_its_substeps(make_vehicle):
    flat = FlatParameters(position=12.72)
    whole, parts = (make_vehicle(offsets=(0.0,), flat=flat) for _ in range(2))
    for k in range(50):
        start, rise = k * 1e-4, 1e-6
        whole.step(start, 1e-4, np.array([(k + 1) * rise]), linear=True)
        for j in range(5):
            u = np.array([(k + (j + 1) / 5) * rise])
            parts.step(start + j * 2e-5, 2e-5, u, linear=True)
    # The same substeps, at times and levels that differ by rounding.
    np.testing.assert_allclose(whole.state[2:], parts.state[2:], rtol=1e-9)


def test_flat_drops_the_load_then_strikes_where_it_is_put(make_vehicle):
    vehicle = make_vehicle(flat=FlatParameters(position=12.8))
    positions, forces = [], []
    for k in range(300):
        vehicle.step(k * 1e-4, 1e-4, np.zeros(2), linear=True)
        positions.append(vehicle.position[0])
        forces.append(vehicle.contact_force)
    flat_wheel, round_wheel = np.array(forces).T
    np.testing.assert_allclose(round_wheel, P, rtol=1e-12)
    before = np.array(positions) < 12.75
    np.testing.assert_allclose(flat_wheel[before], P, rtol=1e-12)
    lost = np.flatnonzero(flat_wheel == 0.0)
    assert 12.75 < positions[lost[0]] < 12.8
    assert positions[int(flat_wheel.argmax())] > positions[lost[0]]
    assert flat_wheel.max() > 3.0 * P


def test_wheels_do_not_know_of_each_other(make_vehicle):
    both = make_vehicle(flat=FlatParameters(wheel=2, position=11.0))
    alone = make_vehicle(
        offsets=(0.0,), initial_position=12.7 - 1.8, flat=FlatParameters(position=11.0)
    )
    forces = run(both, 0.03, 1e-4), run(alone, 0.03, 1e-4)
    # Positions differ by the rounding of 12.7 - 1.8.
    np.testing.assert_allclose(forces[0][:, 1], forces[1][:, 0], rtol=1e-8, atol=1e-6)


def test_periodic_flat_strikes_once_per_turn(make_vehicle):
    turn = 2.0 * math.pi * 0.45
    flat = FlatParameters(length=0.05, depth=5e-5, position=12.8, periodic=True)
    vehicle = make_vehicle(offsets=(0.0,), flat=flat)
    drops = []
    for k in range(6000):
        vehicle.step(k * 1e-4, 1e-4, np.zeros(1), linear=True)
        drops.append(vehicle.displacement[0] + vehicle.gap[0])
    hit = np.flatnonzero((np.array(drops) > 2e-5) & (np.roll(drops, 1) <= 2e-5))
    distance = np.diff(hit) * 1e-4 * SPEED
    assert len(hit) == 3
    np.testing.assert_allclose(distance, turn, atol=1.2e-3)  # one step of 1.1 mm


def test_corrugation_excites_like_a_linear_oscillator(make_vehicle):
    length, amplitude = 0.06, 1e-9
    x = np.linspace(12.7, 13.3, 10 * 400 + 1)
    corrugation = RailIrregularity(
        position=x, drop=amplitude * np.cos(2.0 * np.pi * (x - 12.7) / length)
    )
    vehicle = make_vehicle(offsets=(0.0,), irregularity=corrugation)
    omega, own = 2.0 * math.pi * SPEED / length, math.sqrt(hertz_stiffness(P, C) / MASS)
    forced = amplitude / (1.0 - (omega / own) ** 2)
    worst = 0.0
    for k in range(100):
        vehicle.step(k * 1e-4, 1e-4, np.zeros(1), linear=True)
        t = (k + 1) * 1e-4
        expected = forced * math.cos(omega * t) + (amplitude - forced) * math.cos(own * t)
        worst = max(worst, abs(vehicle.displacement[0] - REST - expected))
    # PCHIP flattens a crest by (2 pi / 400)^2 / 8 = 3e-5; Hertz's curvature adds 1e-5.
    assert worst < 1e-3 * amplitude


def test_level_rail_excites_nothing_beyond_its_table(make_vehicle):
    table = RailIrregularity(position=np.array([0.0, 1.0, 2.0, 3.0]), drop=np.full(4, 1e-3))
    forces = run(make_vehicle(irregularity=table), 0.02, 1e-4)
    np.testing.assert_allclose(forces, P, rtol=1e-12)


def test_position_follows_the_speed_table_without_drift(make_vehicle):
    table = SpeedTable(time=np.array([0.0, 0.1, 0.3]), speed=np.array([10.0, 12.0, 4.0]))
    vehicle = make_vehicle(speed=table)
    run(vehicle, 0.3, 1e-3)
    np.testing.assert_allclose(vehicle.position, 12.7 - np.array([0.0, 1.8]) + 2.7, rtol=1e-14)


def test_start_time_counts_on_the_clock_of_the_speed_table(make_vehicle):
    table = SpeedTable(time=np.array([0.0, 1.0]), speed=np.array([10.0, 20.0]))
    vehicle = make_vehicle(speed=table)
    vehicle.initialise(0.5)
    vehicle.step(0.5, 0.5, np.zeros(2), linear=True)
    assert vehicle.position[0] == pytest.approx(12.7 + 0.5 * 17.5, rel=1e-15)


def test_nothing_works_before_initialise():
    vehicle = VehicleModel(
        VehicleParameters(), flat=FlatParameters(), speed=ConstantSpeed(speed=10.0)
    )
    for use in (
        lambda: vehicle.contact_force,
        lambda: vehicle.state,
        lambda: vehicle.step(0.0, 1e-4, np.zeros(2), linear=True),
    ):
        with pytest.raises(RuntimeError, match="call initialise first"):
            use()
