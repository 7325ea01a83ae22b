"""The dynamic track against a full finite element solution and its own invariants."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from track_fmu.ballast import PolynomialBallast
from track_fmu.beam_element import mass_matrix, stiffness_matrix
from track_fmu.characteristics import LinearCharacteristic
from track_fmu.contact_point import locate
from track_fmu.pads import TotalPad
from track_fmu.support_factors import SupportFactors
from track_fmu.track_model import TrackModel, TrackOptions

from .reference import MIDSPAN, STATIC_LOAD, Track, one_wheel

SPEED = 40.0 / 3.6


# static values: an independent full finite element solution of the Table 1 track


@pytest.mark.parametrize(
    ("ballast", "rail", "sleeper"),
    [(PolynomialBallast(), 1.167e-3, 0.374e-3), (None, 1.982e-3, 1.253e-3)],
    ids=["state-dependent", "linear"],
)
def test_static_displacements_at_midspan(table1, ballast, rail, sleeper):
    model = one_wheel(table1, ballast=ballast)
    model.start(np.array([MIDSPAN]), np.array([STATIC_LOAD]))
    assert model.rail_displacement[0] == pytest.approx(rail, abs=0.6e-6)
    seen = model.observe()
    assert seen.sleeper_displacement.max() == pytest.approx(sleeper, abs=0.6e-6)
    assert seen.ballast_force.sum() == pytest.approx(STATIC_LOAD, rel=1e-6)  # far ends carry 1e-8
    assert seen.pad_force.sum() == pytest.approx(STATIC_LOAD, rel=1e-6)


def test_static_bending_moment_is_that_of_the_untruncated_track(table1):
    """The residual flexibility carries an eighth of the moment under the wheel."""
    exact = np.linalg.solve(table1.matrices.stiffness.toarray(), load_vector(table1, MIDSPAN))
    model = one_wheel(table1, gauges=(MIDSPAN, MIDSPAN + 0.03, 16.9))
    model.start(np.array([MIDSPAN]), np.array([1.0]))
    seen = model.observe()
    expected = [element_moment(table1, exact, x) for x in (MIDSPAN, MIDSPAN + 0.03, 16.9)]
    assert seen.gauge_moment == pytest.approx(expected, rel=1e-7)
    assert seen.wheel_moment[0] == pytest.approx(expected[0], rel=1e-7)
    bare = TrackModel(table1.without_residual(), TrackOptions(wheels=1))
    bare.start(np.array([MIDSPAN]), np.array([1.0]))
    lack = 1.0 - bare.observe().wheel_moment[0] / expected[0]
    assert lack == pytest.approx(0.12, abs=0.01)


def test_moment_between_nodes_is_that_of_a_finer_track(table1):
    """A wheel inside an element: twice and four times the elements place a node under it."""
    position = MIDSPAN + 0.25 * table1.parameters.element_length
    model = one_wheel(table1)
    model.start(np.array([position]), np.array([STATIC_LOAD]))
    finer = Track(150, elements_per_bay=32)
    reference = one_wheel(finer)
    reference.start(np.array([position]), np.array([STATIC_LOAD]))
    ours, theirs = model.observe().wheel_moment[0], reference.observe().wheel_moment[0]
    assert ours == pytest.approx(theirs, rel=2e-5)


def load_vector(track, position, force=1.0):
    point = locate(track.parameters, position)
    vector = np.zeros(track.matrices.mass.shape[0] + 1)  # the last place collects clamped ends
    dofs = track.matrices.numbering.rail[point.element : point.element + 2].ravel()
    np.add.at(vector, dofs, force * point.shape)
    return vector[:-1]


def element_moment(track, displacement, position, *, force=0.0):
    """Sagging moment -EI theta' at a point of an unloaded element (or at its loaded node)."""
    point = locate(track.parameters, position)
    padded = np.append(displacement, 0.0)
    ends = padded[track.matrices.numbering.rail[point.element : point.element + 2].ravel()]
    couples = stiffness_matrix(track.parameters.section, track.parameters.element_length) @ ends
    left, right = couples[1] - force * point.shape[1], -couples[3]
    return (1 - point.xi) * left + point.xi * right


def test_standing_equilibrium_stays_put(table1):
    model = one_wheel(table1, ballast=PolynomialBallast())
    position, force = np.array([16.3]), np.array([STATIC_LOAD])
    model.start(position, force)
    start = model.rail_displacement[0]
    for _ in range(200):
        model.step(1e-4, position, force)
    assert model.rail_displacement[0] == pytest.approx(start, rel=1e-11)
    assert abs(model.observe().rail_velocity[0]) < 1e-9


@pytest.mark.parametrize("linear", [True, False])
@pytest.mark.parametrize("step", [5e-4, 2e-3, 0.02])
def test_long_steps_are_stable(table1, step, linear):
    """An undivided step of 2 ms would blow a disturbance up by 1.4 each time."""
    model = TrackModel(table1.reduced, TrackOptions(), ballast=PolynomialBallast())
    positions, forces = np.array([16.6, 14.8]), np.array([STATIC_LOAD, STATIC_LOAD])
    model.start(positions, forces)
    rest = model.rail_displacement
    model.step(step, positions, 1.001 * forces, linear=linear)
    for _ in range(int(1.0 / step)):
        model.step(step, positions, forces, linear=linear)
    assert model.rail_displacement == pytest.approx(rest, rel=1e-6)  # of 1e-3 at first


def test_a_long_step_is_its_parts(table1):
    whole, parts = (one_wheel(table1, ballast=PolynomialBallast()) for _ in range(2))
    for model in (whole, parts):
        model.start(np.array([16.0]), np.array([STATIC_LOAD]))
    whole.step(2e-3, np.array([16.02]), np.array([1.2 * STATIC_LOAD]))
    for part in (0.25, 0.5, 0.75, 1.0):
        load = STATIC_LOAD * (1.0 + 0.2 * part)
        parts.step(5e-4, np.array([16.0 + 0.02 * part]), np.array([load]))
    assert whole.rail_displacement == pytest.approx(parts.rail_displacement, rel=1e-12)


def test_a_moving_start_is_quieter_than_a_standing_one(table1):
    def disturbance(initial_speed):
        model = one_wheel(table1, ballast=PolynomialBallast(), initial_speed=initial_speed)
        force = np.array([STATIC_LOAD])
        model.start(np.array([12.7]), force)
        history = []
        for k in range(1, 101):
            model.step(1e-4, np.array([12.7 + SPEED * 1e-4 * k]), force)
            history.append(model.rail_displacement[0])
        # displacement relative to the same wheel long under way
        settled = one_wheel(table1, ballast=PolynomialBallast(), initial_speed=SPEED)
        settled.start(np.array([8.8]), force)
        for k in range(1, 3511):
            settled.step(1e-4, np.array([8.8 + SPEED * 1e-4 * k]), force)
        for k, value in enumerate(history, start=3511):
            settled.step(1e-4, np.array([8.8 + SPEED * 1e-4 * k]), force)
            history[k - 3511] = value - settled.rail_displacement[0]
        return np.abs(history).max()

    assert disturbance(SPEED) < 0.5 * disturbance(0.0)  # 0.12 and 0.31 um of 1.1 mm


class FullTrack:
    """The same track, untruncated, by a general-purpose integrator."""

    def __init__(self, track, ballast):
        self.track, self.ballast = track, ballast
        self.mass = track.matrices.mass.toarray()
        self.damping = track.matrices.damping.toarray()
        self.stiffness = track.matrices.stiffness.toarray()
        self.sleeper = track.matrices.numbering.sleeper
        self.size = len(self.mass)

    def internal(self, displacement, velocity):
        force = self.stiffness @ displacement + self.damping @ velocity
        if self.ballast is not None:
            x, v = displacement[self.sleeper], velocity[self.sleeper]
            force[self.sleeper] += self.ballast.force(x, v, np.arange(len(x)))
        return force

    def run(self, position, force, stop, times):
        inverse = np.linalg.inv(self.mass)

        def rate(time, state):
            x, v = state[: self.size], state[self.size :]
            load = load_vector(self.track, position(time), force(time))
            return np.concatenate([v, inverse @ (load - self.internal(x, v))])

        return solve_ivp(
            rate,
            (0.0, stop),
            np.zeros(2 * self.size),
            method="DOP853",
            t_eval=times,
            rtol=1e-9,
            atol=1e-13,
        ).y


def wave_force(time):
    return 6e4 * (1 - np.cos(2 * np.pi * 200 * time))


def position_at(time):
    return 2.2 + 20.0 * time


def driven(model, step, count):
    model.start(np.array([position_at(0.0)]), np.array([wave_force(0.0)]))
    history = []
    for k in range(1, count + 1):
        time = k * step
        model.step(step, np.array([position_at(time)]), np.array([wave_force(time)]))
        history.append(model.rail_displacement[0])
    return np.array(history)


@pytest.mark.parametrize("ballast", [None, PolynomialBallast()], ids=["linear", "state-dependent"])
def test_moving_oscillating_load_against_the_full_model(short, ballast):
    """All modes kept: the only error is the step, of second order."""
    stop = 0.02
    reference = FullTrack(short, ballast).run(position_at, wave_force, stop, [stop])[:, -1]
    size = reference.size // 2
    point = load_vector(short, position_at(stop))
    expected = point @ reference[:size]
    errors = []
    for count in (400, 800, 1600):
        model = one_wheel(short, ballast=ballast, supports_per_wheel=7)
        value = driven(model, stop / count, count)[-1]
        errors.append(abs(value - expected) / abs(expected))
        sleepers = model.observe().sleeper_displacement
    assert errors[-1] < 4e-5  # a step of 12.5 us against a load of 200 Hz
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.25)
    assert np.log2(errors[1] / errors[2]) == pytest.approx(2.0, abs=0.25)
    numbering = short.matrices.numbering
    assert sleepers == pytest.approx(reference[:size][numbering.sleeper], abs=4e-5 * expected)


def test_velocity_moment_and_support_forces_against_the_full_model(short):
    stop, count = 0.02, 3200
    ballast = PolynomialBallast()
    full = FullTrack(short, ballast)
    state = full.run(position_at, wave_force, stop, [stop])[:, -1]
    x, v = state[: full.size], state[full.size :]
    gauge = 3.25  # a node away from the wheel
    model = one_wheel(short, ballast=ballast, supports_per_wheel=7, gauges=(gauge,))
    driven(model, stop / count, count)
    seen = model.observe()
    point = locate(short.parameters, position_at(stop))
    slope = np.zeros(full.size)
    dofs = short.matrices.numbering.rail[point.element : point.element + 2].ravel()
    slope[dofs] = point.slope
    velocity = load_vector(short, position_at(stop)) @ v + 20.0 * slope @ x
    assert seen.rail_velocity[0] == pytest.approx(velocity, rel=1e-4)
    numbering = short.matrices.numbering
    sleeper, rail = numbering.sleeper, numbering.rail[numbering.support_node, 0]
    pads = 80e6 * (x[rail] - x[sleeper]) + 15e3 * (v[rail] - v[sleeper])
    assert seen.pad_force == pytest.approx(pads, abs=1e-4 * np.abs(pads).max())
    beds = 30e6 * x[sleeper] + 31e3 * v[sleeper]
    beds += ballast.force(x[sleeper], v[sleeper], np.arange(7))
    assert seen.ballast_force == pytest.approx(beds, abs=1e-4 * np.abs(beds).max())
    load = load_vector(short, position_at(stop), wave_force(stop))
    acceleration = np.linalg.solve(full.mass, load - full.internal(x, v))
    moment = element_moment(short, x, gauge) + inertia_moment(short, acceleration, gauge)
    assert seen.gauge_moment[0] == pytest.approx(moment, rel=1e-4)


def inertia_moment(track, acceleration, position):
    point = locate(track.parameters, position)
    ends = acceleration[track.matrices.numbering.rail[point.element : point.element + 2].ravel()]
    return (mass_matrix(track.parameters.section, track.parameters.element_length) @ ends)[1]


def test_work_of_the_load_is_stored_or_dissipated(short):
    """Rail velocity at a standing load: power in = change of energy + dissipation."""
    model = one_wheel(short)
    position, step, count = np.array([2.6]), 2e-5, 1000
    basis, matrices = short.basis, short.matrices
    mass, damping, stiffness = (
        m.toarray() for m in (matrices.mass, matrices.damping, matrices.stiffness)
    )
    modes = basis.modes * basis.weight

    def motion():
        q = model._state.modal
        x = np.real(modes @ q)
        v = np.real(modes @ (basis.eigenvalues * q + model._state.load))
        return x, v

    model.start(position, np.array([0.0]))
    work = loss = 0.0
    power_before = loss_before = 0.0
    for k in range(1, count + 1):
        force = wave_force(k * step)
        model.step(step, position, np.array([force]))
        _, v = motion()
        power, dissipation = force * model.observe().rail_velocity[0], v @ damping @ v
        work += 0.5 * step * (power + power_before)
        loss += 0.5 * step * (dissipation + loss_before)
        power_before, loss_before = power, dissipation
    x, v = motion()
    stored = 0.5 * (x @ stiffness @ x + v @ mass @ v)
    assert work == pytest.approx(stored + loss, rel=2e-4)  # the trapezoidal sums are O(step^2)
    assert loss > 0.1 * work


def test_pads_changed_by_increments_are_pads_changed_in_the_matrices(short):
    """Eq. (20): twice the pad stiffness and damping, by force law and by assembly."""
    stiffer = Track(69, bays=8, elements_per_bay=4, pad_stiffness=2 * 80e6, pad_damping=2 * 15e3)
    twice = np.full(7, 2.0)
    pad = TotalPad(
        characteristic=LinearCharacteristic(),
        linear_stiffness=80e6,
        linear_damping=15e3,
        factors=replace(SupportFactors.nominal(7), pad_stiffness=twice, pad_damping=twice),
    )
    stop, differences = 0.02, []
    for count in (500, 1000):
        by_law = driven(one_wheel(short, pad=pad, supports_per_wheel=7), stop / count, count)
        by_matrix = driven(one_wheel(stiffer), stop / count, count)
        differences.append(np.abs(by_law - by_matrix).max() / np.abs(by_matrix).max())
    assert differences[1] < 1e-4
    assert differences[0] / differences[1] > 3.0  # second order in the step


def test_held_inputs_are_of_first_order_and_linear_ones_of_second(short):
    fine = driven(one_wheel(short), 0.02 / 6400, 6400)[-1]
    orders = {}
    for linear in (True, False):
        errors = []
        for count in (100, 200, 400):
            model = one_wheel(short)
            model.start(np.array([position_at(0.0)]), np.array([wave_force(0.0)]))
            for k in range(1, count + 1):
                at = (k if linear else k - 1) * 0.02 / count
                model.step(
                    0.02 / count,
                    np.array([position_at(at)]),
                    np.array([wave_force(at)]),
                    linear=linear,
                )
            errors.append(abs(model.rail_displacement[0] - fine))
        orders[linear] = np.log2(errors[1] / errors[2])
    assert orders[True] == pytest.approx(2.0, abs=0.3)
    assert orders[False] == pytest.approx(1.0, abs=0.3)


def test_overdamped_track_steps_like_the_full_model():
    """Real first-order states: ballast damping of five times Table 1."""
    track = Track(69, bays=8, elements_per_bay=4, ballast_damping=150e3)
    assert np.count_nonzero(track.reduced.weight == 1.0) > 0
    stop = 0.02
    reference = FullTrack(track, None).run(position_at, wave_force, stop, [stop])[:, -1]
    expected = load_vector(track, position_at(stop)) @ reference[: reference.size // 2]
    assert driven(one_wheel(track), stop / 1600, 1600)[-1] == pytest.approx(expected, rel=1e-5)
