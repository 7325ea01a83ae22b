"""The track that finds its contact forces: laws kept at every step, second order, any wheels."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from track_fmu.ballast import PolynomialBallast
from track_fmu.contact_track import LONGEST_PART, ContactTrack
from track_fmu.continuation import begin, continued, remember
from track_fmu.track_model import TrackModel, TrackOptions

from .reference import STATIC_LOAD

HERTZ = 9.17e10
SPEED = 40.0 / 3.6
MIDDLE = 2.6  # m, of the short track


class Hertz:
    def force(self, compression):
        return HERTZ * np.maximum(compression, 0.0) ** 1.5

    def stiffness(self, compression):
        return 1.5 * HERTZ * np.sqrt(np.maximum(compression, 0.0))

    def compression(self, force):
        return (force / HERTZ) ** (2.0 / 3.0)


class Level:
    def drops(self, positions):
        return np.zeros_like(positions)


class Dip:
    """A dip of 0.3 mm, 0.2 m long."""

    def drops(self, positions):
        distance = np.clip(positions - MIDDLE - 0.1, -0.1, 0.1)
        return 0.15e-3 * (1.0 + np.cos(np.pi * distance / 0.1))


def contact_track(short, *, wheels=1, surface=None, speed=0.0):
    options = TrackOptions(wheels=wheels, initial_speed=speed)
    model = TrackModel(short.reduced, options, ballast=PolynomialBallast())
    return ContactTrack(model, law=Hertz(), surface=surface or Level(), static_load=STATIC_LOAD)


class Slope:
    """Down by one in a hundred, with waves of 0.1 m."""

    def drops(self, positions):
        return 0.01 * positions + 1e-5 * np.sin(20.0 * np.pi * positions)


def test_a_vehicle_may_ask_for_loads_and_come_with_a_velocity(short):
    track = contact_track(short, wheels=2, surface=Slope(), speed=SPEED)
    positions, change = np.array([3.0, 2.0]), np.array([3e4, -2e4])
    velocity = 0.01 * SPEED
    track.start(positions, np.zeros(2), load_change=change, velocity=np.full(2, velocity))
    assert track.contact_force == pytest.approx(STATIC_LOAD + change, rel=1e-15)
    assert track.mean_velocity == pytest.approx([velocity] * 2, abs=2e-5)
    steep = velocity + 20.0 * np.pi * 1e-5 * SPEED
    assert track.static_velocity == pytest.approx([steep] * 2, rel=1e-6)
    # known at the start of a step only, the displacement goes on with its velocity
    step = 1e-4
    track.step(step, positions, np.zeros(2), linear=False)
    moved = positions + SPEED * step
    free = velocity * step + track.static_displacement - Slope().drops(moved)
    assert -track.gap == pytest.approx(free - track.rail_displacement, abs=1e-15)


def test_a_wheel_that_would_start_off_the_rail_is_refused(short):
    track = contact_track(short)
    for told, message in (
        ({"load_change": -1.1 * STATIC_LOAD}, "wheel 1 starts with a load of -11772 N"),
        ({"load_change": np.nan}, "load change nan N and velocity 0 m/s of wheel 1 must be finite"),
        ({"velocity": np.inf}, "and velocity inf m/s of wheel 1 must be finite"),
    ):
        with pytest.raises(ValueError, match=message):
            track.start(np.array([MIDDLE]), np.zeros(1), **told)


def gap_of(track, displacements):
    """On a level surface, from what is visible outside."""
    return track.rail_displacement - (displacements + track.static_displacement)


def assert_laws_hold(track, displacements):
    """Force over gap, and a gap that is what wheel and rail leave; to rounding of micrometres."""
    assert track.gap == pytest.approx(gap_of(track, displacements), abs=1e-16)
    assert track.contact_force == pytest.approx(Hertz().force(-track.gap), rel=1e-12)
    assert (track.in_contact == (track.contact_force > 0.0)).all()
    assert (track.contact_force * np.maximum(track.gap, 0.0) == 0.0).all()


# continuation


def test_a_parabola_is_continued_exactly_whatever_the_steps():
    values = np.array([1.0, -3.0])

    def parabola(t):
        return values * (0.3 + 2.0 * t - 5.0 * t * t)

    history, ages = np.zeros((3, 2)), np.zeros(2)
    begin(history, ages, parabola(0.0), rate=np.zeros(2), age=1.0)
    time = 0.0
    for passed in (0.1, 0.03, 0.2):
        time += passed
        remember(history, ages, parabola(time), passed)
    assert continued(history, ages, 0.0) == pytest.approx(parabola(time), rel=1e-15)
    assert continued(history, ages, 0.15) == pytest.approx(parabola(time + 0.15), rel=1e-13)


def test_a_start_is_continued_at_its_rate():
    history, ages = np.zeros((3, 1)), np.zeros(2)
    begin(history, ages, np.array([5.0]), rate=np.array([2.0]), age=1e-4)
    assert continued(history, ages, 1e-4) == pytest.approx([5.0 + 2e-4], rel=1e-15)


# static start


@pytest.mark.parametrize("given_at_start", [0.0, 0.7e-3, -12.0])
def test_wheels_at_rest_stay_at_rest_whatever_their_displacement_is_called(short, given_at_start):
    """The static equilibrium is one of the dynamic model too: 1e-9 of the load in 100 steps."""
    track = contact_track(short, wheels=2)
    positions, displacements = np.array([MIDDLE, MIDDLE - 1.8]), np.full(2, given_at_start)
    track.start(positions, displacements)
    assert (track.contact_force == STATIC_LOAD).all()
    for _ in range(100):
        track.step(1e-4, positions, displacements, linear=False)
    assert track.contact_force == pytest.approx(np.full(2, STATIC_LOAD), rel=1e-9)


def test_a_moving_start_does_not_jump(short):
    """A wheel that keeps its level feels the rail's stiffness vary, but no step of the force."""
    track = contact_track(short, speed=SPEED)
    track.start(np.array([MIDDLE]), np.zeros(1))
    forces = [track.contact_force[0]]
    for k in range(20):
        track.step(1e-4, np.array([MIDDLE + 1e-4 * k * SPEED]), np.zeros(1), linear=False)
        forces.append(track.contact_force[0])
    assert np.abs(np.diff(forces)).max() < 5e-3 * STATIC_LOAD


# every step


@settings(max_examples=40, deadline=None)
@given(
    levels=st.lists(st.tuples(*[st.floats(-2e-3, 1.5e-3)] * 4), min_size=1, max_size=4),
    step=st.sampled_from([1e-6, 1e-4, 2e-4, 1e-3]),
    linear=st.booleans(),
)
def test_force_and_gap_exclude_each_other(short, levels, step, linear):
    """Four wheels in two bogies, thrown about: contact is lost and found from step to step."""
    track = contact_track(short, wheels=4)
    positions = np.array([4.2, 3.5, 1.7, 1.0])
    track.start(positions, np.zeros(4))
    for level in levels:
        displacements = np.array(level)
        if linear:
            track.step(step, positions, displacements, linear=True)
            assert_laws_hold(track, displacements)
        else:
            track.step(step, positions, displacements, linear=False)
            force = track.contact_force
            assert force == pytest.approx(Hertz().force(-track.gap), rel=1e-12)
            assert (force * np.maximum(track.gap, 0.0) == 0.0).all()


def test_a_wheel_lifted_off_leaves_the_track_alone_and_comes_back(short):
    track = contact_track(short)
    free = TrackModel(short.reduced, TrackOptions(wheels=1), ballast=PolynomialBallast())
    position, lifted = np.array([MIDDLE]), np.array([-5e-3])
    track.start(position, np.zeros(1))
    free.start(position, np.array([STATIC_LOAD]))
    for _ in range(50):
        track.step(1e-4, position, lifted, linear=True)
        free.step(1e-4, position, track.contact_force)
    assert not track.in_contact[0]
    assert track.contact_force[0] == 0.0
    assert track.gap[0] > 3e-3
    assert track.rail_displacement == pytest.approx(free.rail_displacement, rel=1e-9)
    for _ in range(1000):
        track.step(1e-4, position, np.zeros(1), linear=True)
    assert track.contact_force[0] == pytest.approx(STATIC_LOAD, rel=5e-3)  # it rings for long


def roll(short, step, *, linear, wheels=1):
    """Over the dip, wheels heaving by 0.1 mm at 30 Hz; forces at every 0.4 ms."""
    track = contact_track(short, wheels=wheels, surface=Dip(), speed=SPEED)
    behind = 0.7 * np.arange(wheels)

    def motion(t):
        return MIDDLE + SPEED * t - behind, np.full(wheels, 0.1e-3 * (1 - np.cos(60 * np.pi * t)))

    track.start(*motion(0.0))
    forces = []
    for k in range(round(0.01 / step)):
        track.step(step, *motion(step * (k + 1 if linear else k)), linear=linear)
        if (k + 1) % round(4e-4 / step) == 0:
            forces.append(track.contact_force)
    return np.array(forces)


@pytest.mark.parametrize("linear", [True, False])
def test_forces_converge_with_the_second_order_of_the_step(short, linear):
    finest = roll(short, 1.25e-5, linear=linear)
    errors = [np.abs(roll(short, h, linear=linear) - finest).max() for h in (1e-4, 5e-5)]
    # the reference's own error, 1/64 and 1/16 of these, makes the order look larger by 0.07
    assert np.log2(errors[0] / errors[1]) > 1.8, errors
    assert errors[0] < 0.01 * STATIC_LOAD


def test_both_ways_to_give_the_motion_lead_to_the_same_force(short):
    """One continues what the other is told; the error of the parabola is of third order."""
    told, continued_ = (roll(short, 5e-5, linear=linear) for linear in (True, False))
    assert np.abs(told - continued_).max() < 2e-3 * STATIC_LOAD


def test_long_steps_are_divided(short):
    whole, parts = contact_track(short), contact_track(short)
    position, end = np.array([MIDDLE]), np.array([0.2e-3])
    for track in (whole, parts):
        track.start(position, np.zeros(1))
    whole.step(4.0 * LONGEST_PART, position, end, linear=True)
    for share in (0.25, 0.5, 0.75, 1.0):
        parts.step(LONGEST_PART, position, share * end, linear=True)
    assert whole.contact_force == pytest.approx(parts.contact_force, rel=1e-12)


def test_the_force_ahead_is_that_of_the_middle_of_the_next_step(short):
    track = contact_track(short)
    position = np.array([MIDDLE])
    track.start(position, np.zeros(1))
    assert track.contact_force_ahead[0] == STATIC_LOAD
    before = track.contact_force[0]
    track.step(1e-4, position, np.array([1e-5]), linear=True)
    now = track.contact_force[0]
    assert track.contact_force_ahead[0] == pytest.approx(now + 0.5 * (now - before), rel=1e-14)
    for _ in range(3):
        track.step(1e-4, position, np.array([-5e-3]), linear=True)
    assert track.contact_force_ahead[0] == 0.0


# state


def test_a_restored_state_repeats_itself_bit_for_bit(short):
    def go_on(track, first):
        for k in range(first, first + 10):
            track.step(
                1e-4, positions + 1e-3 * k, np.array([1e-4, -1e-3]) * np.sin(0.3 * k), linear=False
            )
        return track.contact_force.tobytes() + track.state.tobytes()

    positions = np.array([MIDDLE, MIDDLE - 1.0])
    track = contact_track(short, wheels=2, surface=Dip())
    track.start(positions, np.zeros(2))
    go_on(track, 0)
    saved = track.state
    expected = go_on(track, 10)
    track.step(3e-4, positions, np.zeros(2), linear=False)
    track.state = saved
    assert go_on(track, 10) == expected
    other = contact_track(short, wheels=2, surface=Dip())
    other.state = saved
    assert go_on(other, 10) == expected


@pytest.mark.parametrize(
    ("step", "position", "displacement", "sentence"),
    [
        (0.0, MIDDLE, 0.0, "step size 0.0 s must be greater than 0"),
        (1e-4, 5.3, 0.0, "position 5.3 m lies outside the track of 0 to 5.2 m"),
        (1e-4, MIDDLE, np.nan, "displacement nan m of wheel 1 must be a finite number"),
    ],
)
def test_impossible_steps_are_refused_and_leave_the_state(
    short, step, position, displacement, sentence
):
    track = contact_track(short)
    track.start(np.array([MIDDLE]), np.zeros(1))
    before = track.state.tobytes()
    with pytest.raises(ValueError, match=sentence):
        track.step(step, np.array([position]), np.array([displacement]), linear=False)
    assert track.state.tobytes() == before


def test_a_hopeless_step_is_refused_and_leaves_the_state(short):
    """A wheel pressed in by a metre."""
    track = contact_track(short)
    track.start(np.array([MIDDLE]), np.zeros(1))
    before = track.state.tobytes()
    with pytest.raises(RuntimeError, match="did not converge in"):
        track.step(1e-4, np.array([MIDDLE]), np.array([1.0]), linear=True)
    assert track.state.tobytes() == before


@pytest.mark.parametrize("load", [-1.0, np.inf])
def test_an_impossible_static_load_is_refused(short, load):
    model = TrackModel(short.reduced, TrackOptions(wheels=1))
    with pytest.raises(ValueError, match="static_wheel_load"):
        ContactTrack(model, law=Hertz(), surface=Level(), static_load=load)
