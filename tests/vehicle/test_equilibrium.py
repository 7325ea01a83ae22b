"""Where a suspended vehicle starts: closed forms of equilibrium and velocities."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from vehicle_fmu.bodies import observe_bodies
from vehicle_fmu.contact import hertz_compression
from vehicle_fmu.equilibrium import follow, settle
from vehicle_fmu.irregularity import RailIrregularity
from vehicle_fmu.masses import MassesParameters
from vehicle_fmu.parameters import FlatParameters, VehicleParameters
from vehicle_fmu.speed import ConstantSpeed
from vehicle_fmu.standing import Standing
from vehicle_fmu.suspended_masses import SuspendedMasses
from vehicle_fmu.suspended_vehicle import SuspendedVehicle
from vehicle_fmu.suspension import Suspension
from vehicle_fmu.suspension_parameters import GRAVITY, BodyParameters, SuspensionElement, Tread

from .suspended import HALF_BASE, HALF_PIVOT, OFFSETS

P, M, C = 80e3, 900.0, 9.17e10
K, S = 1.2e6, 430e3
STOP = {"clearance": 1e-3, "stop_stiffness": 4e6}
SHAPES = {
    "coach": (OFFSETS, 2),
    "three axles": ((0.0, 1.7, 3.4), 1),
    "two bogies of three axles": ((0.0, 1.7, 3.4, 12.0, 13.7, 15.4), 2),
    "three bogies": ((0.0, 2.0, 8.0, 10.0, 16.0, 18.0), 3),
    "single wheels": ((0.0, 6.0, 13.0), 3),
}
heights = st.lists(st.floats(-0.02, 0.02), min_size=6, max_size=6).map(np.array)


def suspension(shape, *, tread=None, **stops):
    offsets, bogies = SHAPES[shape]
    return Suspension(
        offsets=offsets,
        wheel_mass=M,
        load=P,
        tread=tread,
        bogies=bogies,
        bodies=BodyParameters(
            bogie_mass=(1300.0,) * bogies,
            bogie_pitch_inertia=(700.0,) * bogies,
            primary=SuspensionElement(stiffness=K, damping=4e3, **stops),
            secondary=SuspensionElement(stiffness=S, damping=20e3),
        ),
    )


def started(shape, rail, *, irregularity=None, speed=25.0, **options):
    offsets, _ = SHAPES[shape]
    model = SuspendedVehicle(
        VehicleParameters(
            offsets=offsets, wheel_mass=M, static_wheel_load=P, hertz_coefficient=C,
            initial_position=0.0,
        ),
        flat=FlatParameters(shape="none"),
        speed=ConstantSpeed(speed=speed),
        suspension=suspension(shape, **options),
        irregularity=irregularity,
    )  # fmt: skip
    model.initialise(0.0, np.array(rail, dtype=float))
    return model


@settings(max_examples=60, deadline=None)
@given(shape=st.sampled_from(sorted(SHAPES)), rail=heights, stops=st.sampled_from([{}, STOP]))
def test_nothing_pushes_any_body_and_the_loads_balance(shape, rail, stops):
    """Newton's law of every body; force and moment of the whole vehicle about its front."""
    offsets = np.array(SHAPES[shape][0])
    model = started(shape, rail[: len(offsets)], **stops)
    q, v = model.coordinates
    acceleration = model.suspension.acceleration(q, v, model.push)
    # to a rounding of contact forces and springs, over the lightest masses
    assert np.abs(acceleration).max() < 1e-9
    assert model.contact_force.sum() == pytest.approx(P * len(offsets), rel=1e-10)
    moment = P * offsets.sum()
    assert model.contact_force @ offsets == pytest.approx(moment, rel=1e-10)


@pytest.mark.parametrize(
    ("rail", "bogies", "pitches", "car"),
    [
        ([1, 1, -1, -1], [1, -1], [0, 0], 1 / HALF_PIVOT),  # car nose down
        ([1, -1, 1, -1], [0, 0], [1 / HALF_BASE, 1 / HALF_BASE], 0),
        ([1, -1, -1, 1], [0, 0], [1 / HALF_BASE, -1 / HALF_BASE], 0),
        ([2, 0, 0, -2], [1, -1], [1 / HALF_BASE, 1 / HALF_BASE], 1 / HALF_PIVOT),
    ],
)
def test_two_wheels_a_bogie_carry_their_load_at_any_height(rail, bogies, pitches, car):
    """Statically determinate: bodies lie on straight lines, whether stops are closed or not."""
    size = 5e-3
    for closed in ({}, {"clearance": -1e-3, "stop_stiffness": 1e6}):
        model = started("coach", size * np.array(rail), tread=Tread(mass=300.0, stiffness=8e8),
                        **closed)  # fmt: skip
        assert model.contact_force == pytest.approx([P] * 4, rel=1e-12)
        seen = observe_bodies(model)
        assert seen["primary_force"] == pytest.approx([P - M * GRAVITY] * 4, rel=1e-12)
        assert seen["bogie_displacement"] == pytest.approx(size * np.array(bogies), abs=1e-15)
        assert seen["bogie_pitch"] == pytest.approx(size * np.array(pitches), abs=1e-15)
        assert seen["car_pitch"][0] == pytest.approx(size * car, abs=1e-15)
        assert seen["car_displacement"][0] == pytest.approx(0.0, abs=1e-15)


def taken(height, give, contacts=1):
    """What a raised middle support of three takes over: its neighbours lose half of it each.

    `give` is what a support gives way by under a force beyond its static one.
    """

    def miss(force):
        up = give(force) + hertz_compression(P + force / contacts, C)
        down = give(-0.5 * force) + hertz_compression(P - 0.5 * force / contacts, C)
        return up - down - height

    return brentq(miss, 0.0, 1.9 * P * contacts, xtol=1e-7, rtol=1e-14)


@pytest.mark.parametrize("height", [1e-4, 5e-3, 0.05])
def test_a_raised_middle_axle_takes_load_from_its_neighbours(height):
    force = taken(height, lambda f: f / K)
    assert force > 0.6 * height * K / (1.0 + K / 1e9)  # 2 / 3 but for the contacts
    model = started("three axles", [0.0, -height, 0.0])
    assert model.contact_force == pytest.approx([P - force / 2, P + force, P - force / 2], rel=1e-9)
    frame = observe_bodies(model)["bogie_displacement"][0]
    # from the mean height of the wheels under their static loads
    level = force / K - height + hertz_compression(P + force, C)
    assert frame == pytest.approx(level - hertz_compression(P, C) + height / 3.0, abs=1e-12)


def test_its_bump_stop_takes_the_more():
    """The middle spring meets its stop, the others do not: two straight lines by hand."""

    def give(force):
        met = K * STOP["clearance"]
        beyond = force - met
        return force / K if beyond < 0.0 else STOP["clearance"] + beyond / (K + 4e6)

    force = taken(8e-3, give)
    assert force > 1.1 * taken(8e-3, lambda f: f / K)
    assert force > 2.0 * K * STOP["clearance"]
    model = started("three axles", [0.0, -8e-3, 0.0], **STOP)
    assert model.contact_force[1] == pytest.approx(P + force, rel=1e-9)


def test_a_raised_middle_bogie_takes_load_from_its_neighbours():
    force = taken(0.02, lambda f: f / S + 0.5 * f / K, contacts=2)
    model = started("three bogies", [0.0, 0.0, -0.02, -0.02, 0.0, 0.0])
    changes = np.repeat([-0.25 * force, 0.5 * force, -0.25 * force], 2)
    assert model.contact_force == pytest.approx(P + changes, rel=1e-9)
    seen = observe_bodies(model)
    static = 2.0 * (P - M * GRAVITY) - 1300.0 * GRAVITY
    assert seen["secondary_force"][1] == pytest.approx(static + force, rel=1e-9)


def test_a_wheel_over_a_deep_dip_hangs_on_its_spring():
    model = started("three axles", [0.0, 0.2, 0.0])
    assert model.contact_force == pytest.approx([1.5 * P, 0.0, 1.5 * P], rel=1e-9)
    assert model.gap[1] > 0.05
    assert observe_bodies(model)["primary_force"][1] == pytest.approx(-M * GRAVITY, rel=1e-9)


def test_held_wheels_bear_what_the_springs_push_them_with():
    """The same equilibrium where the contacts are elsewhere and tell how high the wheels are."""
    model = started("two bogies of three axles", [0.0, 4e-3, -1e-3, 2e-3, 0.0, 5e-3])
    own = model.suspension
    q, _ = model.coordinates
    held = settle(own, follow(own, q[:6]))
    assert held == pytest.approx(q, abs=1e-12)
    assert P - own.resistance(held)[:6] == pytest.approx(model.contact_force, rel=1e-9)


@pytest.mark.parametrize("shape", ["coach", "two bogies of three axles"])
def test_masses_stand_still_where_they_are_told_to(shape):
    """The other side of the contacts: displacements from where they are, loads to ask for."""
    offsets, _ = SHAPES[shape]
    n = len(offsets)
    model = SuspendedMasses(
        MassesParameters(offsets=offsets, wheel_mass=M, static_wheel_load=P),
        speed=ConstantSpeed(speed=25.0),
        suspension=suspension(shape, **STOP),
    )
    height = 0.02 * np.sin(np.arange(n) ** 2)
    standing = Standing(displacement=height, velocity=np.zeros(n), mean_velocity=np.zeros(n))
    model.initialise(0.0, np.full(n, P), standing)
    change = model.load_change
    assert (change == 0.0).all() == (shape == "coach")
    assert [change.sum(), change @ np.array(offsets)] == pytest.approx([0.0, 0.0], abs=1e-6)
    model.initialise(0.0, P + change, standing)
    for k in range(20):
        model.step(5e-3 * k, 5e-3, P + change, linear=True)
    # a tenth of a second under rounded forces
    assert np.abs(model.displacement).max() < 1e-12
    if shape == "coach":
        first = observe_bodies(model)["bogie_displacement"][0]
        assert first == pytest.approx(height[:2].mean() - height.mean(), abs=1e-12)


def test_masses_move_on_as_they_are_told_to():
    """Down a gradient at a velocity that nothing changes."""
    model = SuspendedMasses(
        MassesParameters(offsets=OFFSETS, wheel_mass=M, static_wheel_load=P),
        speed=ConstantSpeed(speed=25.0),
        suspension=suspension("coach"),
    )
    slope = np.full(4, 0.25)
    standing = Standing(displacement=np.zeros(4), velocity=slope, mean_velocity=slope)
    model.initialise(0.0, np.full(4, P), standing)
    model.step(0.0, 0.1, np.full(4, P), linear=False)
    assert model.displacement == pytest.approx(0.1 * slope, rel=1e-12)
    assert observe_bodies(model)["car_displacement"][0] == pytest.approx(0.025, rel=1e-12)


def test_a_standing_that_is_no_number_is_refused():
    with pytest.raises(ValueError, match="static velocity of wheel 2 is nan m/s"):
        Standing(displacement=np.zeros(2), velocity=np.array([0.0, np.nan]),
                 mean_velocity=np.zeros(2))  # fmt: skip


def test_what_has_no_equilibrium_in_numbers_is_refused():
    with pytest.raises(ValueError, match="finds no static equilibrium on wheels displaced by"):
        started("three axles", [0.0, 1e300, 0.0])


def rail_of(drop, *, end=60.0, spacing=0.01):
    x = np.arange(-60.0, end, spacing)
    return RailIrregularity(position=x, drop=drop(x))


@pytest.mark.parametrize("shape", ["coach", "two bogies of three axles"])
def test_on_a_gradient_everything_moves_along_as_if_it_were_level(shape):
    """A slope of one in a hundred at 25 m/s: from rest, wheels would meet it with 0.25 m/s."""
    wheels = len(SHAPES[shape][0])
    model = started(shape, np.zeros(wheels), irregularity=rail_of(lambda x: 0.01 * x))
    for k in range(100):
        model.step(1e-3 * k, 1e-3, np.zeros(wheels), linear=True)
        # to a rounding of 0.6 m in a compression of 0.1 mm
        assert model.contact_force == pytest.approx([P] * wheels, rel=1e-8)
    assert observe_bodies(model)["car_displacement"][0] == pytest.approx(0.025, rel=1e-6)


def test_wheels_follow_short_waves_at_the_start_and_bodies_do_not():
    wave, depth = 0.06, 5e-5
    number = 2.0 * np.pi / wave
    rail = rail_of(lambda x: depth * np.sin(number * x), end=60.0, spacing=1e-3)
    model = started("coach", np.zeros(4), irregularity=rail, speed=20.0)
    expected = 20.0 * depth * number * np.cos(number * np.array(OFFSETS))
    # slopes of monotone cubics through sixty points a wave are off by (2 pi / 60)^2 at most
    assert model.velocity == pytest.approx(expected, abs=1.1e-2 * 20.0 * depth * number)
    _, rates = model.coordinates
    assert np.abs(rates[4:]).max() <= 2.0 * depth / HALF_BASE  # over `SWAY`, one second
