"""The suspended vehicle against matrices put together by hand, scipy, and its own energy."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import eigvals, expm

from vehicle_fmu.integration import substeps_of
from vehicle_fmu.suspended_motion import advance
from vehicle_fmu.suspension import Suspension
from vehicle_fmu.suspension_parameters import (
    GRAVITY,
    BodyParameters,
    SuspensionElement,
    Tread,
    car_mass,
)

from .suspended import (
    CAR,
    LOAD,
    MASS,
    OFFSETS,
    PRIMARY,
    SECONDARY,
    TREAD,
    WHEEL,
    coach,
    matrix_of,
)

FREE = 4 * 2  # the first coordinate behind wheels and hubs


def linearised(suspension, kept):
    """Matrix of the first-order system of the kept coordinates, column by column."""
    size, count = len(suspension.inverse_mass), len(kept)
    system = np.zeros((2 * count, 2 * count))
    system[:count, count:] = np.eye(count)
    nothing = np.zeros(suspension.wheels)
    for column in range(2 * count):
        q, v = np.zeros(size), np.zeros(size)
        (q if column < count else v)[kept[column % count]] = 1e-3
        system[count:, column] = suspension.acceleration(q, v, nothing)[kept] / 1e-3
    return system


def sorted_roots(matrix):
    return np.sort_complex(eigvals(matrix))


def test_modes_on_a_rigid_rail_are_those_of_the_matrices_put_together_by_hand():
    size = len(MASS)
    stiffness, damping = (matrix_of(p, s) for p, s in zip(PRIMARY, SECONDARY, strict=True))
    by_hand = np.block(
        [
            [np.zeros((size, size)), np.eye(size)],
            [-np.linalg.solve(MASS, stiffness), -np.linalg.solve(MASS, damping)],
        ]
    )
    model = linearised(coach(), list(range(FREE, FREE + size)))
    np.testing.assert_allclose(sorted_roots(model), sorted_roots(by_hand), rtol=1e-9, atol=1e-9)
    # what a coach is like: bounce of the body near 1 Hz, of the bogies near 7 Hz
    frequencies = np.sort(np.abs(sorted_roots(by_hand).imag)) / (2.0 * np.pi)
    assert frequencies[frequencies > 0.1][0] == pytest.approx(1.0, abs=0.2)
    assert frequencies[-1] == pytest.approx(11.6, abs=2.5)


def test_a_flexible_wheelset_vibrates_as_two_masses_do():
    """Free: its hub and tread against each other, and the whole of it moving along."""
    tread, stiffness, _ = TREAD
    wheels = Suspension(
        offsets=(0.0,),
        wheel_mass=WHEEL,
        load=LOAD,
        tread=Tread(mass=tread, stiffness=stiffness),
        bogies=1,
        bodies=None,
    )
    roots = sorted_roots(linearised(wheels, [0, 1]))
    omega = np.sqrt(stiffness * (1.0 / tread + 1.0 / (WHEEL - tread)))
    assert np.abs(roots.imag).max() == pytest.approx(omega, rel=1e-9)
    assert np.sort(np.abs(roots))[:2] == pytest.approx([0.0, 0.0], abs=1e-3)


def held(_, displacement):
    """A stiff linear spring under every wheel in place of the contact."""
    return -1.5e9 * displacement


def kicked(suspension):
    random = np.random.default_rng(6)
    moving = suspension.inverse_mass > 0.0
    size = len(moving)
    return 1e-3 * random.normal(size=size) * moving, 0.1 * random.normal(size=size) * moving


def run(suspension, duration, substeps, push=held, start=None):
    q, v = start or kicked(suspension)
    return advance(suspension, q, v, duration=duration, substeps=substeps, push=push)


def test_substeps_of_20_us_are_the_exponential_of_the_linear_system():
    """The linear part needs none: the fastest mode is off by 7e-5 after 90 periods."""
    suspension, duration = coach(tread=TREAD), 0.2
    size = len(suspension.inverse_mass)
    system = linearised(suspension, list(range(size)))
    system[size : size + 4, :4] -= np.eye(4) * 1.5e9 * suspension.inverse_mass[0]
    q, v = kicked(suspension)
    exact = expm(system * duration) @ np.concatenate([q, v])
    found = np.concatenate(run(suspension, duration, substeps_of(duration, 2e-5)))
    for part in (slice(0, size), slice(size, None)):
        scale = np.abs(exact[part]).max()
        np.testing.assert_allclose(found[part], exact[part], rtol=0.0, atol=1e-4 * scale)


def test_motion_with_dampers_converges_with_order_four():
    suspension, duration = coach(tread=TREAD), 8e-3
    reference = np.concatenate(run(suspension, duration, 3200))
    errors = [
        np.abs(np.concatenate(run(suspension, duration, n)) - reference).max()
        for n in (100, 200, 400)
    ]
    for coarse, fine in pairwise(errors):
        assert np.log2(coarse / fine) == pytest.approx(4.0, abs=0.15)


def test_without_dampers_the_energy_stays_with_stops_that_are_met():
    suspension = coach(
        tread=(TREAD[0], TREAD[1], 0.0), primary=(1.2e6, 0.0), secondary=(430e3, 0.0),
        clearance=2e-3, stop_stiffness=5e6,
    )  # fmt: skip
    start = kicked(suspension)

    def energy(q, v):
        return suspension.energy(q, v) + 0.5 * 1.5e9 * (q[:4] ** 2).sum()

    before = energy(*start)
    met = 0
    for _ in range(50):
        start = run(suspension, 2e-3, 200, start=start)
        met += bool(((suspension.incidence @ start[0])[4:8] > 2e-3).any())
        assert energy(*start) == pytest.approx(before, rel=1e-6)
    assert met > 5


def test_dampers_take_what_the_energy_loses():
    """Over time the work of the dampers, by Simpson's rule, is the energy that is gone."""
    suspension, h = coach(), 1e-4
    state = kicked(suspension)
    rate = suspension.incidence
    damping = np.array([PRIMARY[1]] * 4 + [SECONDARY[1]] * 2)

    def energy(q, v):
        return suspension.energy(q, v) + 0.5 * 1.5e9 * (q[:4] ** 2).sum()

    def power(v):
        return float((damping * (rate @ v) ** 2).sum())

    before, lost = energy(*state), 0.0
    for _ in range(500):
        middle = run(suspension, 0.5 * h, 10, start=state)
        end = run(suspension, 0.5 * h, 10, start=middle)
        lost += h / 6.0 * (power(state[1]) + 4.0 * power(middle[1]) + power(end[1]))
        state = end
    assert lost > 0.1 * before
    assert before - energy(*state) == pytest.approx(lost, rel=1e-4)


@pytest.mark.parametrize("ratio", [1.0, 3.0])
@pytest.mark.parametrize("clearance", [4e-3, -3e-3])
def test_quarter_car_on_a_step_is_that_of_scipy(ratio, clearance):
    """One wheel that is lifted by 10 mm, with a bump stop and a damper harder in rebound."""
    bogie, car, load = 1500.0, 4000.0, (600.0 + 1500.0 + 4000.0) * GRAVITY
    primary = SuspensionElement(
        stiffness=1.2e6, damping=12e3, rebound_ratio=ratio, clearance=clearance, stop_stiffness=4e6
    )
    suspension = Suspension(
        offsets=(0.0,), wheel_mass=600.0, load=load, tread=None, bogies=1,
        bodies=BodyParameters(
            bogie_mass=(bogie,), car_mass=car, primary=primary,
            secondary=SuspensionElement(stiffness=3e5, damping=2e4),
        ),
    )  # fmt: skip
    rise, rail = -10e-3, 2e8

    def law(e, rate):
        stop = 4e6 * (max(0.0, e - clearance) - max(0.0, -clearance))
        return 1.2e6 * e + stop + 12e3 * (ratio if rate < 0.0 else 1.0) * rate

    def right(_, y):
        z, b, c, vz, vb, vc = y
        lower = law(b - z, vb - vz)
        upper = 3e5 * (c - b) + 2e4 * (vc - vb)
        contact = rail * (z - rise)
        return [vz, vb, vc, (lower - contact) / 600.0, (upper - lower) / bogie, -upper / car]

    exact = solve_ivp(right, (0.0, 0.1), np.zeros(6), rtol=1e-10, atol=1e-13, max_step=1e-3)
    zero = np.zeros(len(suspension.inverse_mass))
    q, v = advance(
        suspension, zero, zero, duration=0.1, substeps=5_000,
        push=lambda _, z: -rail * (z - rise),
    )  # fmt: skip
    places = [0, 2, 4]  # wheel, bogie, car body
    assert q[places] == pytest.approx(exact.y[:3, -1], abs=1e-8)
    assert v[places] == pytest.approx(exact.y[3:, -1], abs=1e-6)


def test_the_load_bears_the_masses():
    suspension = coach()
    zero = np.zeros(len(suspension.inverse_mass))
    forces = suspension.forces(zero, zero)
    on_wheel = LOAD - WHEEL * GRAVITY
    assert forces[:4] == pytest.approx([on_wheel] * 4, rel=1e-14)
    assert forces[4:] == pytest.approx([0.5 * CAR * GRAVITY] * 2, rel=1e-12)
    bodies = BodyParameters(bogie_mass=(1307.5,) * 2, bogie_pitch_inertia=(738.0,) * 2)
    assert car_mass(bodies, wheels=4, wheel_mass=WHEEL, load=LOAD) == pytest.approx(CAR, rel=1e-12)


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"load": 10e3}, "have 6241 kg over this rail, the static wheel loads carry 4077"),
        ({"bodies": BodyParameters(car_mass=1e5)}, "raise static_wheel_load"),
        ({"offsets": (0.0, 1.8, 3.6), "bogies": 2}, "3 wheels cannot be shared out among 2"),
        ({"tread": Tread(mass=906.5, stiffness=1e9)}, "tread.mass is 906.5 kg; it must be below"),
    ],
)
def test_vehicles_that_cannot_be_are_refused(values, sentence):
    bodies = BodyParameters(bogie_mass=(BOGIES,) * 2, bogie_pitch_inertia=(738.0,) * 2)
    usual = {"offsets": OFFSETS, "wheel_mass": WHEEL, "load": LOAD, "tread": None, "bogies": 2,
             "bodies": bodies} | values  # fmt: skip
    if "bodies" in values:
        usual |= {"bogies": 1}
    with pytest.raises(ValueError, match=sentence):
        Suspension(**usual)


BOGIES = 1307.5


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: SuspensionElement(stiffness=-1.0), "stiffness is -1 N/m"),
        (lambda: SuspensionElement(stiffness=1.0, rebound_ratio=-1.0), "rebound_ratio is -1; it"),
        (lambda: SuspensionElement(stiffness=1.0, clearance=np.nan), "clearance is nan m"),
        (lambda: Tread(mass=100.0, stiffness=0.0), "tread.stiffness is 0 N/m"),
        (lambda: BodyParameters(bogie_mass=(0.0,)), r"bogie\[1\].mass is 0 kg"),
        (lambda: BodyParameters(bogie_mass=()), "0 bogie masses and 1 pitch inertias"),
        (lambda: BodyParameters(car_pitch_inertia=0.0), "car.pitch_inertia is 0 kg m2"),
    ],
)
def test_impossible_parameters_are_refused(make, sentence):
    with pytest.raises(ValueError, match=sentence):
        make()
