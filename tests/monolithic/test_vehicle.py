"""The vehicle of the monolith: closed forms of its modes, balances of forces and of energy."""

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from railcosim.monolithic.scenario_vehicle import vehicle_of
from railcosim.monolithic.springs import Spring, Springs
from railcosim.scenario_file import read_scenario
from vehicle_fmu.suspension_parameters import GRAVITY

WHEELS, BOGIES = 4, 2
WHEEL, FRAME, FRAME_INERTIA, CAR_INERTIA = 906.5, 1307.5, 738.0, 985e3
HALF_BASE, HALF_PIVOT = 1.28, 9.5
AXLE_LOAD = 11.0
CAR = WHEELS * (500.0 * AXLE_LOAD - WHEEL) - BOGIES * FRAME
PRIMARY, SECONDARY = 1.2e6, 430e3
COACH = (
    "vehicle.model=suspended",
    f"vehicle.wheels={WHEELS}",
    f"vehicle.bogies={BOGIES}",
    f"vehicle.wheel_mass={WHEEL}",
    f"vehicle.axle_load_t={AXLE_LOAD}",
    f"vehicle.axle_base={2.0 * HALF_BASE}",
    f"vehicle.bogie_distance={2.0 * HALF_PIVOT}",
    f"suspension.bogie_mass={FRAME}",
    f"suspension.bogie_pitch_inertia={FRAME_INERTIA}",
    f"suspension.car_pitch_inertia={CAR_INERTIA}",
    f"suspension.primary_stiffness={PRIMARY}",
    f"suspension.secondary_stiffness={SECONDARY}",
    "flat.position=26.35",
    "run.approach=1",
    "run.departure=1",
)
TREAD = ("suspension.tread_mass=300", "suspension.tread_stiffness=8e8")
STOPS = (
    "suspension.primary_clearance=1e-3",
    "suspension.primary_stop_stiffness=5e6",
    "suspension.secondary_clearance=-2e-3",
    "suspension.secondary_stop_stiffness=1e6",
)
UNDAMPED = (
    "suspension.primary_damping=0",
    "suspension.secondary_damping=0",
)
KINDS = {"rigid wheels": (), "flexible wheelsets": TREAD}


def coach(*keys):
    return vehicle_of(read_scenario(None, (*COACH, *keys)))


def frequencies(matrix):
    """Circular frequencies from accelerations over coordinates, ascending."""
    return np.sqrt(np.sort(-np.linalg.eigvals(matrix).real))


def pair(mass, above, stiffness, between):
    """Circular frequencies of a mass on a spring to the ground that carries another on a second."""
    total = (stiffness + between) / mass + between / above
    root = np.sqrt(total**2 - 4.0 * stiffness * between / (mass * above))
    return np.sqrt([0.5 * (total - root), 0.5 * (total + root)])


def test_modes_on_held_wheels():
    """Bounce, pitch of the car body with its bogies, and pitch of every bogie: all decoupled."""
    vehicle = coach()
    rest = np.zeros(len(vehicle.scale))
    stiffness, _ = vehicle.tangent(rest, rest)
    bounce = pair(FRAME, CAR / BOGIES, 2.0 * PRIMARY, SECONDARY)
    pitch = pair(FRAME, CAR_INERTIA / (BOGIES * HALF_PIVOT**2), 2.0 * PRIMARY, SECONDARY)
    frame = HALF_BASE * np.sqrt(2.0 * PRIMARY / FRAME_INERTIA)
    expected = np.sort([*bounce, *pitch, frame, frame])
    assert frequencies(stiffness[WHEELS:, WHEELS:]) == pytest.approx(expected, rel=1e-9)


def test_a_flexible_wheelset_by_itself():
    """A free tread and hub vibrate against each other with their reduced mass."""
    vehicle = vehicle_of(read_scenario(None, ("vehicle.wheels=1", *TREAD)))
    stiffness, _ = vehicle.tangent(np.zeros(2), np.zeros(2))
    reduced = 300.0 * (592.5 - 300.0) / 592.5
    found = np.sqrt(np.abs(np.linalg.eigvals(stiffness)).max())
    assert found == pytest.approx(np.sqrt(8e8 / reduced), rel=1e-12)
    assert vehicle.observe(np.zeros((2, 1)), np.zeros((2, 1)), np.zeros((2, 1))) == {}


def test_static_equilibrium():
    """Every load is the weight of what is above it."""
    vehicle = coach(*STOPS)
    rest = np.zeros((len(vehicle.scale), 1))
    assert (vehicle.accelerations(rest[:, 0], rest[:, 0], np.zeros(WHEELS)) == 0.0).all()
    seen = vehicle.observe(rest, rest, rest)
    assert seen["secondary_force"].sum() == pytest.approx(GRAVITY * CAR, rel=1e-12)
    frames = BOGIES * FRAME
    assert seen["primary_force"].sum() == pytest.approx(GRAVITY * (CAR + frames), rel=1e-12)


def masses_of(keys):
    """Masses and moments of inertia of all coordinates."""
    wheels = [300.0] * WHEELS + [WHEEL - 300.0] * WHEELS if TREAD[0] in keys else [WHEEL] * WHEELS
    above = [FRAME] * BOGIES + [FRAME_INERTIA] * BOGIES + [CAR, CAR_INERTIA]
    return np.array(wheels + above)


@pytest.mark.parametrize("keys", KINDS.values(), ids=KINDS)
def test_springs_only_pass_forces_on(keys):
    """Momentum, and angular momentum about the middle, change by what pushes the wheels alone."""
    vehicle = coach(*keys, *STOPS, "suspension.primary_rebound_ratio=3")
    random = np.random.default_rng(2)
    size = len(vehicle.scale)
    place, rate = 5e-3 * random.standard_normal(size), random.standard_normal(size)
    push = 1e4 * random.standard_normal(WHEELS)
    inertial = masses_of(keys) * vehicle.accelerations(place, rate, push)
    wheel = np.array([HALF_PIVOT + HALF_BASE, HALF_PIVOT - HALF_BASE])
    wheel = np.concatenate((wheel, -wheel[::-1]))
    levers = np.concatenate(
        [
            *[wheel] * (2 if keys else 1),
            [HALF_PIVOT, -HALF_PIVOT],
            [1.0, 1.0],
            [0.0, 1.0],
        ]
    )
    up = size - BOGIES - 2  # pitch angles of frames are no displacements
    shifts = np.array([*inertial[: up - BOGIES], *inertial[up - BOGIES : up], inertial[-2]])
    assert shifts.sum() == pytest.approx(push.sum(), rel=1e-9)
    assert levers @ inertial == pytest.approx(wheel @ push, rel=1e-9)


def potential(place, *, flexible):
    """Energy of the coach's springs and stops from static equilibrium, by its geometry [J]."""
    rail, above = place[:WHEELS], place[-2 * BOGIES - 2 :]
    frames, pitches, (car, car_pitch) = above[:BOGIES], above[BOGIES:-2], above[-2:]
    hubs = place[WHEELS : 2 * WHEELS] if flexible else rail
    ends = (frames[:, None] + pitches[:, None] * [HALF_BASE, -HALF_BASE]).ravel()
    primary = ends - hubs
    secondary = car + car_pitch * np.array([HALF_PIVOT, -HALF_PIVOT]) - frames
    springs = (
        4e8 * ((hubs - rail) ** 2).sum()
        + 0.5 * PRIMARY * (primary**2).sum()
        + 0.5 * SECONDARY * (secondary**2).sum()
    )
    met = np.maximum(secondary + 2e-3, 0.0)  # the secondary stop bears 2 kN at rest
    carried = 0.5e6 * (met**2 - 4e-6) - 2e3 * secondary
    return springs + 2.5e6 * (np.maximum(primary - 1e-3, 0.0) ** 2).sum() + carried.sum()


@pytest.mark.parametrize("keys", KINDS.values(), ids=KINDS)
@pytest.mark.parametrize("damped", [False, True])
def test_energy(keys, damped):
    """Conserved through bump stops without dampers; with one-sided ones it only falls."""
    dampers = ("suspension.primary_rebound_ratio=2",) if damped else UNDAMPED
    vehicle, masses = coach(*keys, *STOPS, *dampers), masses_of(keys)
    size = len(masses)
    start = np.zeros(2 * size)
    start[size : size + WHEELS] = -0.1, 0.05, -0.05, -0.1  # up, into the primary stops

    def rates(_, state):
        place, rate = np.split(state, 2)
        return np.concatenate((rate, vehicle.accelerations(place, rate, np.zeros(WHEELS))))

    solution = solve_ivp(rates, (0.0, 0.1), start, rtol=1e-8, atol=1e-11, method="DOP853")
    stored = np.array([potential(place, flexible=bool(keys)) for place in solution.y[:size].T])
    energy = stored + 0.5 * (masses[:, None] * solution.y[size:] ** 2).sum(axis=0)
    assert stored.max() > 0.2 * energy[0]
    if damped:
        assert (np.diff(energy) < 1e-7 * energy[0]).all()
        assert energy[-1] < 0.8 * energy[0]
    else:
        assert energy == pytest.approx(np.full_like(energy, energy[0]), rel=1e-6)


@pytest.mark.parametrize("clearance", [2e-3, 0.0, -2e-3])
def test_a_spring_with_a_stop(clearance):
    """Its force is the integral of its stiffness, which is that of its tangent."""
    springs = Springs(
        [
            Spring(
                stiffness=3e5,
                damping=2e3,
                rebound_ratio=4.0,
                clearance=clearance,
                stop_stiffness=9e5,
            )
        ]
    )
    at_rest = np.zeros(1)
    for compression in (-5e-3, 1e-3, 5e-3):
        force = springs.force(np.array([compression]), at_rest)[0]
        work = quad(
            lambda e: springs.tangent(np.array([e]), at_rest)[0][0],
            0.0,
            compression,
            points=[clearance],
        )[0]
        assert force == pytest.approx(work, rel=1e-9)
    assert springs.force(at_rest, np.array([-0.1])) == pytest.approx([-0.1 * 8e3])
    assert springs.force(at_rest, np.array([0.1])) == pytest.approx([0.1 * 2e3])
    assert springs.ways_to_stops(np.array([1e-3])) == pytest.approx([clearance - 1e-3])
