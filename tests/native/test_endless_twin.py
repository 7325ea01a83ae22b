"""The native endless track agrees with the numpy model, seam after seam."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from .derivatives import check_derivative
from .library import DiscardedError
from .twins import assert_alike

STATIC_LOAD = 117_720.0
SPEED = 40.0
BAY = 0.65
MOVE = 2  # bays, of twelve
SIDES = pytest.mark.parametrize("ahead", [1.0, -1.0], ids=["forwards", "backwards"])


def offset(native):
    return round(native.group("window_position")[0] / BAY)


@SIDES
@pytest.mark.parametrize("linear", [True, False])
@pytest.mark.parametrize("ballast", ["state_dependent", "linear"])
def test_over_many_bays(track_pair, short_track, ahead, linear, ballast):
    pair = track_pair(
        short_track, linear=linear, speed=ahead * SPEED, ballast=ballast, endless=True
    )
    random = np.random.default_rng(3)
    positions = np.array([1.2, -0.6])
    pair.start(positions, np.full(2, STATIC_LOAD))
    first, offsets = offset(pair.native), set()
    for _ in range(400):
        step = random.choice([1e-4, 2e-4, 1.1e-3])
        positions = positions + ahead * SPEED * step
        pair.step(step, positions, STATIC_LOAD * random.uniform(0.5, 1.5, 2))
        offsets.add(offset(pair.native))
    moves = sorted(ahead * (place - first) for place in offsets)
    assert moves == list(range(0, len(moves) * MOVE, MOVE))
    assert len(moves) > 5
    assert_alike(pair.outputs())


@settings(
    max_examples=30, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(
    ahead=st.sampled_from([1.0, -1.0]),
    bays=st.floats(0.0, 3.0),
    linear=st.booleans(),
    seed=st.integers(0, 2**32 - 1),
)
def test_step_from_random_states(track_pair, short_track, ahead, bays, linear, seed):
    """Wheels anywhere in the window, so that it moves at once or not, either way."""
    pair = track_pair(short_track, linear=linear, speed=SPEED, endless=True)
    random = np.random.default_rng(seed)
    places = 900.0 * random.uniform(-1.0, 1.0) + np.array([0.0, -1.8])
    pair.start(places, np.full(2, STATIC_LOAD))
    state = pair.numpy.state
    scattered = state * random.uniform(0.7, 1.3, len(state))
    scattered[:2] = places + ahead * bays * BAY
    scattered[-1] = state[-1]
    pair.copy_state(scattered)
    pair.step(2e-4, scattered[:2] + 0.005, STATIC_LOAD * np.array([1.2, 0.7]))
    assert_alike(pair.states())
    assert_alike(pair.outputs())


def at_the_seam(native, model, **values):
    """An instance whose next step moves the window, and the wheels' positions after that."""
    track = native(model, linear_inputs=True, initial_speed=SPEED, endless=True, **values)
    positions = np.array([5000.0, 4998.2])
    track.enter()
    track.set_group("wheel[#].position", positions)
    track.exit()
    first = offset(track)
    while True:
        before = track.state
        positions = positions + SPEED * 2e-4
        track.set_group("wheel[#].position", positions)
        track.step(track.time, 2e-4)
        if offset(track) != first:
            track.state = before
            return track, positions


@pytest.mark.parametrize("model", ["track", "track_contact"])
def test_a_step_over_the_seam_is_repeated_bit_for_bit(native, model):
    track, positions = at_the_seam(native, model)
    saved, ends = track.state, []
    pressed = "contact_force" if model == "track" else "displacement"
    inputs = track.group(f"wheel[#].{pressed}")
    for change in (0.0, 1e-5, 0.0):
        track.state = saved
        track.set_group("wheel[#].position", positions)
        track.set_group(f"wheel[#].{pressed}", inputs + change)
        track.step(track.time, 2e-4)
        ends.append(track.state.tobytes())
    assert ends[0] == ends[2] != ends[1]


@pytest.mark.parametrize("step", [2e-4, 1.2e-3])
@pytest.mark.parametrize(("quantity", "size"), [("contact_force", 30.0), ("position", 1e-5)])
def test_derivatives_over_the_seam(native, quantity, size, step):
    track, positions = at_the_seam(native, "track")
    track.set_group("wheel[#].position", positions + SPEED * (step - 2e-4))
    unknowns = [
        *(f"wheel[{i}].rail_displacement" for i in (1, 2)),
        *(f"sleeper[{i}].displacement" for i in (5, 6)),
        "window_position",
    ]
    knowns = [f"wheel[{i}].{quantity}" for i in (1, 2)]
    check_derivative(track, knowns, [1.0, -0.4], unknowns, step=step, size=size, agreement=1e-6)


@pytest.mark.parametrize("linear", [True, False])
def test_contacts_over_many_bays(contact_pair, short_track, linear):
    """A flat that strikes once a turn, the wheels held at their static levels."""
    flat = {"flat.position": 101.0, "flat.periodic": True}
    pair = contact_pair(short_track, values=flat | {"endless": True, "initial_speed": SPEED})
    positions, random = np.array([100.0, 98.2]), np.random.default_rng(5)
    pair.start(positions, np.zeros(2))
    first = offset(pair.native)
    for _ in range(500):
        positions = positions + SPEED * 2e-4
        pair.step(2e-4, positions, 2e-5 * random.uniform(-1.0, 1.0, 2), linear=linear)
    assert offset(pair.native) >= first + 2 * MOVE
    assert_alike(pair.states(), parts=10)  # Newton's iteration ends within 1e-8 N
    assert_alike(pair.outputs(), parts=10)


@pytest.mark.parametrize("model", ["track", "track_contact"])
@pytest.mark.parametrize(
    ("place", "sentence"),
    [
        (np.nan, r"position nan m must be a number of at most 1e\+09 m"),
        (-1e12, r"position -1000000000000 m must be"),
        (5010.0, "position 50.* m lies outside the window of 4996.55 to 5004.35 m that moves"),
    ],
)
def test_refused_steps_change_nothing(native, model, place, sentence):
    track, _ = at_the_seam(native, model)
    track.set_group("wheel[#].position", [place, 5001.0])
    before = track.state
    for step in (2e-4, 4e-4):
        with pytest.raises(DiscardedError, match=sentence):
            track.step(track.time, step)
        assert track.state.tobytes() == before.tobytes()
