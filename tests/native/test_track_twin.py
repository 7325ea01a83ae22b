"""The native track agrees with the numpy model, which is its specification."""

from math import ceil

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fmu_src.native.model_resources import track_resource
from track_fmu.parameters import TrackParameters
from track_fmu.track_model import LONGEST_STEP

from .library import DiscardedError, NativeError
from .twins import assert_alike, scaled

STATIC_LOAD = 117_720.0
SPEED = 40.0 / 3.6


@pytest.mark.parametrize("ballast", ["state_dependent", "linear"])
@pytest.mark.parametrize("speed", [0.0, SPEED, 60.0])
@pytest.mark.parametrize("positions", [(4.5, 2.7), (0.1, 7.7), (3.9, 3.9)])
def test_static_start(track_pair, short_track, ballast, speed, positions):
    pair = track_pair(short_track, speed=speed, ballast=ballast)
    pair.start(np.array(positions), np.array([1.3, 0.8]) * STATIC_LOAD)
    assert_alike(pair.outputs())


def test_static_start_without_load(track_pair, short_track):
    pair = track_pair(short_track)
    pair.start(np.array([4.5, 2.7]), np.zeros(2))
    assert (pair.native.group("sleeper[#].displacement") == 0.0).all()


steps = st.floats(-6.0, -2.7).map(lambda exponent: 10.0**exponent)
"""Step sizes [s]; those beyond 0.5 ms are divided."""


@settings(
    max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(
    step=steps,
    linear=st.booleans(),
    supports=st.integers(1, 12),
    speed=st.floats(0.0, 80.0),
    loads=st.tuples(st.floats(-1.0, 3.0), st.floats(-1.0, 3.0)),
    seed=st.integers(0, 2**32 - 1),
)
def test_step_from_random_states(
    track_pair, short_track, step, linear, supports, speed, loads, seed
):
    pair = track_pair(short_track, linear=linear, supports=supports, speed=SPEED)
    random = np.random.default_rng(seed)
    places = random.uniform(0.0, short_track.length - 0.5, 2)
    pair.start(places, np.full(2, STATIC_LOAD))
    state = pair.numpy.state
    scattered = state * random.uniform(0.7, 1.3, len(state))
    scattered[:2] = places
    pair.copy_state(scattered)
    positions, forces = places + speed * step, STATIC_LOAD * np.array(loads)
    pair.set(positions, forces)
    try:
        pair.numpy.step(step, positions, forces, linear=linear)
    except RuntimeError:
        with pytest.raises(DiscardedError, match="did not converge"):
            pair.native.step(0.0, step)
        return
    pair.native.step(0.0, step)
    parts = ceil(step / LONGEST_STEP)
    assert_alike(pair.states(), parts=parts)
    assert_alike(pair.outputs(), parts=parts)


@pytest.mark.parametrize("linear", [True, False])
def test_many_steps(track_pair, short_track, linear):
    """Rounding does not pile up: the track is dissipative."""
    pair = track_pair(short_track, linear=linear, speed=SPEED)
    positions = np.array([3.0, 1.2])
    pair.start(positions, np.full(2, STATIC_LOAD))
    random = np.random.default_rng(7)
    for _ in range(300):
        step = random.choice([5e-5, 1e-4, 2e-4, 1.1e-3])
        positions = positions + SPEED * step
        pair.step(step, positions, STATIC_LOAD * random.uniform(0.0, 2.0, 2))
    assert_alike(pair.outputs())


@pytest.mark.parametrize("mass", [0.0, 50.0], ids=["", "ballast moves along"])
@pytest.mark.parametrize(
    ("values", "pairs", "residual"),
    [
        ({"ballast_damping": 3e5, "pad_damping": 4e4}, 30, True),
        ({"sleeper_spacing": 0.6, "elements_per_bay": 1}, 12, True),
        ({}, 20, False),
        ({"sleeper": "beam"}, 60, True),
        ({"sleeper": "beam", "sleeper_elements": 2, "elements_per_bay": 1}, 25, False),
    ],
    ids=["overdamped", "coarse", "without residual flexibility", "beams", "coarse beams"],
)
def test_other_tracks(track_pair, values, pairs, residual, mass):
    parameters = TrackParameters(**{"bays": 10, "elements_per_bay": 3} | values)
    resource = track_resource(
        parameters, wheels=1, gauges=1, mode_pairs=pairs, residual_flexibility=residual
    )
    pair = track_pair(parameters, resource, gauge=2.1, values={"ballast_mass": mass})
    real = np.count_nonzero(pair.reduced.weight == 1.0)
    assert real == 18 if "ballast_damping" in values else real == 0
    positions = np.array([2.0])
    pair.start(positions, np.array([STATIC_LOAD]))
    # the static start of laws whose tangents change is known to 1e-12 of the increments
    agreement = {"relative": 3e-12} if mass else {}
    assert_alike(pair.outputs(), **agreement)
    for step in (1e-4, 3e-4, 7e-4):
        positions = positions + SPEED * step
        pair.step(step, positions, np.array([1.2 * STATIC_LOAD]))
    assert_alike(scaled(pair.states(), step) if mass else pair.states(), **agreement)
    assert_alike(pair.outputs(), **agreement)


def test_wheels_at_the_ends_of_the_track(track_pair, short_track):
    pair = track_pair(short_track)
    pair.start(np.array([short_track.length, 0.0]), np.full(2, STATIC_LOAD))
    pair.step(1e-4, np.array([short_track.length - 1e-3, 1e-3]), np.full(2, STATIC_LOAD))
    assert_alike(pair.outputs())


@pytest.mark.parametrize(
    ("group", "values", "message"),
    [
        ("wheel[#].position", [4.5, 8.0], "position 8 m lies outside the track of 0 to 7.8 m"),
        ("wheel[#].position", [np.nan, 2.7], "outside the track"),
        ("wheel[#].contact_force", [np.inf, 0.0], "wheel 1 must be a finite number"),
        ("wheel[#].contact_force", [1e14, 0.0], "use a shorter step"),
    ],
)
def test_refused_steps_change_nothing(track_pair, short_track, group, values, message):
    pair = track_pair(short_track)
    pair.start(np.array([4.5, 2.7]), np.full(2, STATIC_LOAD))
    pair.native.set_group(group, values)
    before = pair.native.state
    with pytest.raises(DiscardedError, match=message):
        pair.native.step(0.0, 1e-3)
    assert pair.native.reached == 0.0
    assert pair.native.state.tobytes() == before.tobytes()


@pytest.mark.parametrize("step", [0.0, -1e-4, np.nan, np.inf, 1e300])
def test_steps_that_are_none(track_pair, short_track, step):
    pair = track_pair(short_track)
    pair.start(np.array([4.5, 2.7]), np.full(2, STATIC_LOAD))
    with pytest.raises(DiscardedError, match=r"step size|parts of"):
        pair.native.step(0.0, step)
    with pytest.raises(DiscardedError, match="does not continue"):
        pair.native.step(1e-3, 1e-4)


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("ballast", "soft", "ballast is 'soft'; it must be"),
        ("supports_per_wheel", 0, "must be at least 1"),
        ("initial_speed", np.inf, "must be finite"),
        ("ballast_alpha", np.nan, "must be finite"),
        ("gauge[1].position", -0.1, "outside the track"),
    ],
)
def test_bad_parameters_are_refused(native, name, value, message):
    track = native("track")
    track.set_one(name, value)
    with pytest.raises(NativeError, match=message):
        track.enter()


def test_what_the_basis_fixes_cannot_be_set(native):
    with pytest.raises(NativeError, match="fixed in this FMU"):
        native("track", bending_stiffness=6e6)
