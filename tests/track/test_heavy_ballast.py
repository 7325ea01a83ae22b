"""Ballast that moves along and sleepers that differ in mass: one mass on a spring, and the laws.

The track of one mass is a modal model with a single pair of modes, `rho^2 = 1 / (2 i omega M)`.
"""

from dataclasses import replace

import numpy as np
import pytest

from track_fmu.assembly import assemble
from track_fmu.characteristics import (
    HyperbolicCharacteristic,
    LinearCharacteristic,
    PolynomialCharacteristic,
    TableCharacteristic,
)
from track_fmu.heavy_ballast import HeavyBallast
from track_fmu.modal import compute_basis
from track_fmu.parameters import TrackParameters
from track_fmu.reduction import ReducedTrack, reduce_track
from track_fmu.support_factors import SupportFactors
from track_fmu.total_ballast import TotalBallast
from track_fmu.track_model import TrackModel, TrackOptions

M, K, C = 125.0, 30e6, 31e3
SLEEPER, RAIL = 1226.0, 383.0  # N
PLACE = np.array([0.65])
PAPER = PolynomialCharacteristic(alpha=0.37e12, beta=-2.47e15, delta=5.75e18)
TABLE = np.array([-1e-4, 0.0, 1e-4, 3e-4, 6e-4]), np.array([-2e3, 0.0, 4e3, 2e4, 9e4])
CHARACTERISTICS = {
    "linear": LinearCharacteristic(),
    "polynomial": PAPER,
    "hyperbolic": HyperbolicCharacteristic(stiffness=K, slope=2e3),
    "table": TableCharacteristic(*TABLE, stiffness=K),
}


def heavy(*, mass=0.0, more=0.0, grows=False, bed=CHARACTERISTICS["linear"], **options):
    own = {"linear_stiffness": K, "linear_damping": C, "gap": np.zeros(1), **options}
    own |= {"sleeper_weight": SLEEPER, "rail_weight": RAIL}
    nominal = 1e4 * M  # much more than the one mass that the law is tried on, so that it may lose
    factors = replace(
        SupportFactors.nominal(1), gap=own.pop("gap"), sleeper_mass=np.array([1.0 + more / nominal])
    )
    return HeavyBallast(
        bed=TotalBallast(characteristic=bed, factors=factors, **own),
        mass=mass,
        grows=grows,
        nominal_sleeper=nominal,
    )


def one_mass(law, *, stiffness, mass=M):
    """One mass without damping on a spring, loaded through the rail above it."""
    parameters = TrackParameters(
        bays=2, elements_per_bay=1, ballast_stiffness=stiffness, ballast_damping=0.0
    )
    omega = np.sqrt(stiffness / mass)
    shape = np.zeros((8, 1), dtype=complex)
    shape[[2, 6]] = 1.0 / np.sqrt(2j * omega * mass)
    return TrackModel(
        ReducedTrack(
            parameters=parameters,
            eigenvalues=np.array([1j * omega]),
            weight=np.array([2.0]),
            shape=shape,
            moment_shape=np.zeros((3, 1), dtype=complex),
            flexibility=np.zeros((8, 8)),
            moment_flexibility=np.zeros((3, 8)),
            sleeper_shape=np.zeros((0, 1), dtype=complex),
            sleeper_flexibility=np.zeros((0, 8)),
            bent_shape=np.zeros((0, 1), dtype=complex),
            bent_flexibility=np.zeros((0, 8)),
        ),
        TrackOptions(wheels=1, supports_per_wheel=1),
        ballast=law,
    )


def increment(model):
    parameters = model.track.parameters
    observed = model.observe()
    return -observed.forces[model.track.ballast_rows][: parameters.supports]


@pytest.mark.parametrize("step", [1e-7, 1e-5, 5e-4])
@pytest.mark.parametrize("ratio", [-0.9, -0.5, 0.5, 4.0, 1e3])
def test_a_free_mass_shares_the_force_with_the_mass_added_to_it(ratio, step):
    """`g = m / (M + m) F` and the motion of `M + m`, stable whatever the step."""
    soft = 1e-6  # N/m; next to nothing over the few metres of the motion
    law = heavy(more=ratio * M, linear_stiffness=soft, linear_damping=0.0)
    model = one_mass(law, stiffness=soft)
    model.start(PLACE, np.zeros(1))
    force, steps = 1e3, 60
    for _ in range(steps):
        model.step(step, PLACE, np.array([force]))
        assert increment(model) == pytest.approx(ratio / (1.0 + ratio) * force, rel=1e-6)
    # the force is reached on a straight line over the first step
    moved = force / (M * (1.0 + ratio)) * step**2 * ((steps - 1) ** 2 / 2 + (steps - 1) / 2 + 1 / 6)
    assert model.rail_displacement == pytest.approx(moved, rel=1e-5)


def released(model, *, step, time, force=3e4, left=0.0, over=1e-3):
    """Displacement, rate and time of every step; the force goes smoothly down `over` a while."""
    model.start(PLACE, np.array([force]))
    found = []
    for now in step * np.arange(1, round(time / step) + 1):
        rest = left + (force - left) * np.cos(0.5 * np.pi * min(now / over, 1.0)) ** 2
        model.step(step, PLACE, np.array([rest]))
        found.append((model.rail_displacement[0], model.observe().rail_velocity[0], now))
    return np.array(found).T


@pytest.mark.parametrize("ratio", [-0.5, 1.0, 8.0])
def test_an_oscillator_swings_as_one_of_the_whole_mass_to_second_order(ratio):
    """The other one's mass is in its mode, which is exact under a force on straight lines."""
    errors = []
    for step in (1e-4, 5e-5, 2.5e-5):
        model = one_mass(heavy(more=ratio * M, linear_damping=0.0), stiffness=K)
        other = one_mass(None, stiffness=K, mass=M * (1.0 + ratio))
        x, y = (released(track, step=step, time=5e-3)[0] for track in (model, other))
        errors.append(np.abs(x - y).max())
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders == pytest.approx(2.0, abs=0.1)
    assert errors[-1] < 1e-3 * 3e4 / K


@pytest.mark.parametrize("step", [1e-4, 5e-4])
@pytest.mark.parametrize("ratio", [-0.5, 1.0, 8.0])
def test_a_step_of_a_free_swing_keeps_areas_and_stays_bounded(ratio, step):
    """Its matrix has the determinant 1 and a pair of eigenvalues on the unit circle."""
    model = one_mass(heavy(more=ratio * M, linear_damping=0.0), stiffness=K)
    states = released(model, step=step, time=1e-3 + 4.0 * step)[:2, -4:]
    matrix = states[:, 2:] @ np.linalg.inv(states[:, 1:3])
    assert np.linalg.det(matrix) == pytest.approx(1.0, abs=1e-9)
    np.testing.assert_allclose(np.abs(np.linalg.eigvals(matrix)), 1.0, atol=1e-9)


def test_ballast_whose_mass_grows_keeps_the_energy():
    """`(M + m(x)) x'^2 / 2 + V(x) - F x` of a loaded swing on the paper's ballast.

    To second order in the step where the sleeper stays down: at zero the slope of the mass jumps.
    Without `m_x x'^2 / 2` in the force, half the kinetic energy would come and go.
    """
    own, left, drifts = 60.0, 2e4, []
    for step in (4e-5, 2e-5):
        law = heavy(mass=own, grows=True, bed=PAPER, linear_damping=0.0)
        model = one_mass(law, stiffness=K)
        x, v, now = released(model, step=step, time=9e-3, force=6e4, left=left)
        x, v = x[now > 1e-3], v[now > 1e-3]
        assert x.min() > 0.0
        secant = x * (0.37e12 + x * (-2.47e15 + x * 5.75e18))
        moving = 0.5 * (M + own * (1.0 + secant / K)) * v**2
        spring = 0.5 * K * x**2 + x**3 * (0.37e12 / 3 + x * (-2.47e15 / 4 + x * 5.75e18 / 5))
        drifts.append(np.ptp(moving + spring - left * x) / moving.max())
    assert drifts[1] < 1e-4
    assert drifts[1] < 0.3 * drifts[0]


def test_the_force_on_the_ballast_has_its_inertia_and_not_the_sleepers():
    law = heavy(mass=80.0, more=60.0, linear_damping=0.0)
    model = one_mass(law, stiffness=K)
    model.start(PLACE, np.zeros(1))
    for force in (1e4, 3e4, 2e4):
        model.step(1e-4, PLACE, np.array([force]))
        x = model.rail_displacement[0]
        acceleration = (force - K * x) / (M + 80.0 + 60.0)
        assert model.observe().ballast_force == pytest.approx(K * x + 80.0 * acceleration)


@pytest.mark.parametrize("gap", [0.0, 1e-4])
@pytest.mark.parametrize("pulls", [True, False])
@pytest.mark.parametrize("grows", [True, False])
@pytest.mark.parametrize("kind", CHARACTERISTICS)
def test_tangents_are_the_derivatives_of_the_force(kind, grows, pulls, gap):
    law = heavy(
        mass=150.0,
        more=40.0,
        grows=grows,
        bed=CHARACTERISTICS[kind],
        pulls=pulls,
        gap=np.array([gap]),
    )
    random = np.random.default_rng(3)
    count = 400
    motion = [
        random.uniform(-1e-4, 7e-4, count),
        random.uniform(-0.1, 0.1, count),
        random.uniform(-50.0, 50.0, count),
    ]
    support = np.zeros(count, dtype=np.intp)
    tangents = law.moving_tangents(*motion, support)
    sizes = (1e-9, K), (1e-6, C), (1e-3, M)  # of a difference, and of a derivative
    for axis, ((size, usual), found) in enumerate(zip(sizes, tangents, strict=True)):
        ends = []
        for sign in (1.0, -1.0):
            moved = [values + sign * size * (axis == i) for i, values in enumerate(motion)]
            ends.append(law.moving_force(*moved, support))
        expected = (ends[0] - ends[1]) / (2.0 * size)
        scale = max(np.abs(expected).max(), usual)
        # all but the few points that lie within a difference of a switch
        assert np.mean(np.abs(found - expected) < 1e-4 * scale) > 0.98


def test_ballast_that_does_not_pull_is_not_dragged_along():
    law, weight = heavy(mass=100.0, pulls=False), SLEEPER + RAIL
    x, still, support = np.array([1e-4]), np.zeros(1), np.zeros(1, dtype=np.intp)

    def whole(acceleration):
        force = law.moving_force(x, still, np.array([acceleration]), support)
        return float(force[0] + K * x[0])

    assert whole(10.0) == pytest.approx(K * x[0] + 1e3)
    assert whole(-29.0) == pytest.approx(K * x[0] - 2.9e3)
    assert whole(-46.0) == pytest.approx(K * x[0] - 4.6e3)
    assert whole(-47.0) == pytest.approx(-weight)
    lifted = law.moving_force(-x, still, np.array([47.0]), support)
    assert lifted == pytest.approx(K * x - weight)


def test_a_truncated_set_has_the_sleepers_inertia():
    """What `ComponentMotion` says of it: an acceleration at once, nothing from the force's slope.

    The derivative of the rate's `Q` would be 1e-8 of the force over a step of a millisecond.
    """
    parameters = TrackParameters(bays=10)
    matrices = assemble(parameters)
    basis = compute_basis(matrices, mode_pairs=30)
    track = reduce_track(parameters, matrices, basis)
    shape = track.shape[track.ballast_rows]
    inverse_mass = np.real((shape * track.weight * track.eigenvalues) @ shape.T)
    rest = np.real((shape * track.weight) @ shape.T)
    mass = parameters.sleeper_mass
    np.testing.assert_allclose(mass * inverse_mass, np.eye(9), atol=1e-3)
    assert np.abs(mass * rest).max() < 1e-8


@pytest.mark.parametrize("mass", [-1.0, np.nan, np.inf])
def test_masses_that_no_ballast_has_are_refused(mass):
    with pytest.raises(ValueError, match="must be a finite number, at least 0"):
        heavy(mass=mass)


def test_sleepers_of_next_to_no_mass_are_refused():
    with pytest.raises(ValueError, match=r"of support 1 must be a finite number, at least 0\.1"):
        replace(SupportFactors.nominal(1), sleeper_mass=np.array([0.05]))
