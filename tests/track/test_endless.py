"""The endless track: its window moves unseen, keeps energy, and is restored bit for bit."""

import numpy as np
import pytest

from track_fmu.ballast import PolynomialBallast
from track_fmu.track_model import TrackModel, TrackOptions

from .reference import STATIC_LOAD, Track

SPACING = 0.65
MOVE = 10  # bays at once, of 50
CONTACT_STIFFNESS = 1.9e9  # N/m, the largest under a flat: force that a jump of the rail makes
FORCES = np.array([STATIC_LOAD, STATIC_LOAD])
LAWS = pytest.mark.parametrize("law", [None, PolynomialBallast()], ids=["linear", "dependent"])


def bogie(track, *, law=None, speed=0.0, **options):
    options = {"endless": True, "initial_speed": speed} | options
    return TrackModel(track.reduced, TrackOptions(wheels=2, **options), ballast=law)


def wheels(leading):
    return np.array([leading, leading - 1.8])


def offset(model):
    return round(model.observe().window_position[0] / SPACING)


def drive(model, start, end, *, step=4e-4, speed=60.0):
    """Run under constant forces; rail displacements at the end of every step."""
    count = round(abs(end - start) / (speed * step))
    places = start + (end - start) * np.arange(1, count + 1) / count
    seen = np.empty((count, 2))
    for k, place in enumerate(places):
        model.step(step, wheels(place), FORCES)
        seen[k] = model.rail_displacement
    return places, seen


def at_the_seam(track, law):
    """A moving bogie right before its window moves for the first time."""
    model = bogie(track, law=law, speed=60.0)
    model.start(wheels(1000.0), FORCES)
    place, first = 1000.0, offset(model)
    while offset(model) == first:
        before = model.state, place
        place += 0.012
        model.step(2e-4, wheels(place), FORCES)
    model.state = before[0]
    return model, before[1]


@LAWS
def test_the_seam_is_invisible(table1, law):
    """One step with the move and one without: a jump of the force below 1e-4 of the load."""
    model, place = at_the_seam(table1, law)
    saved = model.state
    seen = []
    for stays in (False, True):
        model.state = saved
        if stays:
            model.window.follow = lambda _: False
        model.step(2e-4, wheels(place + 0.012), FORCES)
        seen.append((model.rail_displacement, model.observe().wheel_moment))
    jump, moment_jump = (np.abs(moved - stayed).max() for moved, stayed in zip(*seen, strict=True))
    assert CONTACT_STIFFNESS * jump < 1e-4 * STATIC_LOAD
    assert jump > 0.0  # the window did move
    assert moment_jump < 1e-4 * np.abs(seen[0][1]).max()


@LAWS
def test_a_move_keeps_the_energy_and_the_field(table1, law):
    """Sleepers are those of ten bays on, and what the window holds of energy stays."""
    model, _ = at_the_seam(table1, law)
    before, energy = model.observe(), physical_energy(table1, model)
    sleepers, ballast = before.sleeper_displacement.copy(), before.ballast_force.copy()
    model.follow_wheels()
    after = model.observe()
    largest = np.abs(sleepers).max()
    assert after.sleeper_displacement[:-MOVE] == pytest.approx(sleepers[MOVE:], abs=1e-5 * largest)
    assert after.ballast_force[:-MOVE] == pytest.approx(ballast[MOVE:], abs=1e-4 * ballast.max())
    # of the retained modes alone, which share a little of it with the truncated ones
    assert physical_energy(table1, model) == pytest.approx(energy, rel=1e-4)


def physical_energy(track, model):
    """Elastic and kinetic energy of the linear track [J], from its matrices."""
    state, matrices, basis = model._state, track.matrices, track.basis
    modal = basis.weight * state.modal
    x = np.real(basis.modes @ modal)
    v = np.real(basis.modes @ (basis.eigenvalues * modal))
    return 0.5 * (x @ (matrices.stiffness @ x) + v @ (matrices.mass @ v))


@LAWS
def test_the_deflection_repeats_itself_with_the_bays(table1, law):
    """A constant load over a hundred bays."""
    model = bogie(table1, law=law, speed=65.0)
    model.start(wheels(20.0), FORCES)
    _, seen = drive(model, 20.0, 20.0 + 100 * SPACING, speed=65.0)  # twenty-five steps a bay
    per_bay = seen.reshape(100, 25, 2)
    largest = seen.max()
    assert offset(model) >= 90
    # from move to move to rounding of the seam, from bay to bay as near as the clamped ends are
    assert per_bay[-MOVE:] == pytest.approx(per_bay[-2 * MOVE : -MOVE], abs=1e-5 * largest)
    assert per_bay[-1] == pytest.approx(per_bay[-2], abs=2e-3 * largest)


@pytest.mark.slow
def test_the_window_of_fifty_bays_answers_as_a_long_track(table1):
    """A hundred ordinary bays: what remains are waves between the ends, at about 1 kHz."""
    law = PolynomialBallast()
    endless = bogie(table1, law=law, speed=60.0)
    long = bogie(Track(300, bays=100), law=law, speed=60.0, endless=False)
    start, end = 22.1, 42.9
    for model in (endless, long):
        model.start(wheels(start), FORCES)
    (_, ours), (_, theirs) = drive(endless, start, end), drive(long, start, end)
    assert offset(endless) > 20
    assert ours == pytest.approx(theirs, abs=1e-3 * theirs.max())


def test_an_endless_track_that_has_not_moved_is_an_ordinary_one(table1):
    states = []
    for endless in (False, True):
        model = bogie(table1, law=PolynomialBallast(), speed=60.0, endless=endless)
        model.start(wheels(17.15), FORCES)
        drive(model, 17.15, 19.0)
        states.append(model.state)
    assert np.array_equal(*states)


def test_backwards_over_the_seam(table1):
    model = bogie(table1, law=PolynomialBallast(), speed=-60.0)
    model.start(wheels(5.0), FORCES)
    first = offset(model)
    assert first < 0
    drive(model, 5.0, -15.0)
    assert offset(model) <= first - 2 * MOVE
    drive(model, -15.0, 5.0)
    for _ in range(500):
        model.step(5e-4, wheels(5.0), FORCES)
    rest = bogie(table1, law=PolynomialBallast())
    rest.start(wheels(5.0), FORCES)
    assert model.rail_displacement == pytest.approx(rest.rail_displacement, rel=1e-5)


def test_a_step_over_the_seam_is_repeated_bit_for_bit(table1):
    model, place = at_the_seam(table1, PolynomialBallast())
    saved = model.state
    ends = []
    for factor in (1.0, 1.3, 1.0):
        model.state = saved
        model.step(2e-4, wheels(place + 0.012), factor * FORCES)
        ends.append(model.state)
    assert np.array_equal(ends[0], ends[2])
    assert not np.array_equal(ends[0], ends[1])


def test_a_long_step_follows_the_wheels_within(table1):
    """Half a second at 60 m/s is 46 bays, and from one end of its stay to the other four more."""
    whole, parts = (bogie(table1, law=PolynomialBallast(), speed=60.0) for _ in range(2))
    for model in (whole, parts):
        model.start(wheels(17.15), FORCES)
    whole.step(0.5, wheels(47.15), FORCES)
    drive(parts, 17.15, 47.15, step=5e-4)
    assert offset(whole) == offset(parts) == 50
    assert whole.rail_displacement == pytest.approx(parts.rail_displacement, rel=1e-9)


def test_gauges_are_seen_while_the_window_holds_them(table1):
    model = bogie(table1, speed=60.0, gauges=(1000.0, 1040.0))
    model.start(wheels(1000.0), FORCES)
    assert model.observe().gauge_moment[0] == pytest.approx(model.observe().wheel_moment[0])
    assert model.observe().gauge_moment[1] == 0.0
    drive(model, 1000.0, 1040.0)
    assert model.observe().gauge_moment[0] == 0.0
    assert model.observe().gauge_moment[1] == pytest.approx(model.observe().wheel_moment[0])


@pytest.mark.parametrize(
    ("place", "sentence"),
    [
        (float("nan"), "position nan m must be a number of at most 1e\\+09 m"),
        (1e12, "position 1000000000000.0 m must be"),
        (60.0, "position 60.0 m lies outside the window of 0.65 to 33.15 m"),
    ],
)
def test_wrong_positions_are_refused_and_change_nothing(table1, place, sentence):
    model = bogie(table1)
    model.start(wheels(17.8), FORCES)
    before = model.state
    with pytest.raises(ValueError, match=sentence):
        model.step(1e-4, wheels(place), FORCES)
    assert np.array_equal(model.state, before)
