"""The native track with contacts agrees with the numpy model, which is its specification."""

from math import ceil

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fmu_src.native.model_resources import track_resource
from track_fmu.contact_track import LONGEST_PART
from track_fmu.parameters import TrackParameters

from .library import DiscardedError, NativeError
from .twins import assert_alike

SPEED = 40.0 / 3.6
FLAT = {"flat.position": 4.55, "initial_speed": SPEED}


@pytest.mark.parametrize("ballast", ["state_dependent", "linear"])
@pytest.mark.parametrize("speed", [0.0, SPEED])
@pytest.mark.parametrize("positions", [(4.55, 2.75), (0.1, 7.7), (3.9, 3.9)])
def test_static_start(contact_pair, short_track, ballast, speed, positions):
    values = FLAT | {"ballast": ballast, "initial_speed": speed}
    pair = contact_pair(short_track, values=values)
    pair.start(np.array(positions), np.array([0.3e-3, -12.0]))
    assert_alike(pair.states())
    assert_alike(pair.outputs())


def test_static_start_without_load(contact_pair, short_track):
    pair = contact_pair(short_track, values={"static_wheel_load": 0.0})
    pair.start(np.array([4.5, 2.7]), np.zeros(2))
    assert (pair.native.group("sleeper[#].displacement") == 0.0).all()
    assert (pair.native.group("wheel[#].gap") == 0.0).all()


steps = st.floats(-5.0, -2.7).map(lambda exponent: 10.0**exponent)
"""Step sizes [s]; those beyond 0.2 ms are divided."""
levels = st.tuples(*[st.floats(-4e-4, 4e-4)] * 2)


@settings(
    max_examples=80, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(
    step=steps,
    linear=st.booleans(),
    supports=st.integers(1, 12),
    speed=st.floats(0.0, 80.0),
    ages=st.tuples(steps, steps, st.sampled_from([0.0, 5e-5, 2e-4])),
    earlier=st.tuples(levels, levels, levels),
    compressions=st.tuples(*[st.floats(-3e-4, 3e-4)] * 2),
    level=levels,
    seed=st.integers(0, 2**32 - 1),
)
def test_step_from_random_states(
    contact_pair,
    short_track,
    step,
    linear,
    supports,
    speed,
    ages,
    earlier,
    compressions,
    level,
    seed,
):
    """Contact lost and found among them, and inputs that were given in another way before."""
    pair = contact_pair(short_track, values=FLAT | {"supports_per_wheel": supports})
    random = np.random.default_rng(seed)
    places = random.uniform(0.2, short_track.length - 0.5, 2)
    pair.start(places, np.zeros(2))
    state = pair.numpy.state
    track, own = np.split(state, [len(state) - pair.own_size])
    track *= random.uniform(0.7, 1.3, len(track))
    own[:2] = compressions
    own[4:6] *= random.uniform(0.7, 1.3, 2)
    first, second, passed = ages
    for k, (age, levels) in enumerate(zip((0.0, first, first + second), earlier, strict=True)):
        own[6 + 4 * k : 10 + 4 * k] = *(places - speed * age), *levels
    own[-3:] = first, first + second, passed
    track[:2] = places
    pair.copy_state(np.concatenate([track, own]))
    positions = np.clip(places + speed * step, 0.0, short_track.length)
    try:
        pair.step(step, positions, np.array(level), linear=linear)
    except (ValueError, RuntimeError):
        with pytest.raises(DiscardedError, match=r"did not converge|outside the track"):
            pair.native_step(step, linear=linear)
        return
    parts = ceil(step / LONGEST_PART)
    assert_alike(pair.states(), parts=parts)
    assert_alike(pair.outputs(), parts=parts)


def drive(pair, positions, *, steps, linear, seed=7):
    """Wheels that hop on the rail; which of them were off it at some time."""
    random = np.random.default_rng(seed)
    off = np.zeros(len(positions), dtype=bool)
    time = 0.0
    for _ in range(steps):
        step = random.choice([3e-5, 1e-4, 2e-4, 7e-4])
        time += step
        now = time if linear else time - step
        level = 1.2e-3 * np.sin(500.0 * now + np.arange(len(positions)))
        pair.step(step, positions + SPEED * now, level, linear=linear)
        off |= ~pair.numpy.in_contact
    return off


@pytest.mark.parametrize("linear", [True, False])
@pytest.mark.parametrize("shape", ["haversine", "chord", "none"])
def test_many_steps_with_loss_of_contact(contact_pair, short_track, linear, shape):
    """Rounding does not pile up, nor at the ends of contacts."""
    pair = contact_pair(short_track, values=FLAT | {"flat.shape": shape})
    pair.start(np.array([4.5, 2.7]), np.zeros(2))
    assert drive(pair, np.array([4.5, 2.7]), steps=200, linear=linear).all()
    assert_alike(pair.outputs())


@pytest.mark.parametrize(
    ("wheels", "positions"), [(1, [4.3]), (4, [6.5, 4.7, 3.6, 1.8])], ids=["one", "two bogies"]
)
def test_any_number_of_wheels(contact_pair, wheels, positions):
    parameters = TrackParameters(bays=13, elements_per_bay=4)
    resource = track_resource(parameters, wheels=wheels, gauges=0, mode_pairs=30, contact=True)
    pair = contact_pair(
        parameters, resource, wheels=wheels, gauges=0, pairs=30,
        values=FLAT | {"flat.wheel": wheels},
    )  # fmt: skip
    pair.start(np.array(positions), np.zeros(wheels))
    assert drive(pair, np.array(positions), steps=60, linear=False).all()
    rows = [row for row in pair.outputs() if len(row[1]) > 0]
    assert_alike(rows)


def test_uneven_surfaces_and_a_rolled_flat(contact_pair, short_track, tmp_path):
    rail, tread = tmp_path / "rail.csv", tmp_path / "tread.csv"
    tread.write_text("0 1e-4\n1 -1e-4\n2.5 5e-5\n5.5 0\n")
    rail.write_text("4.0, 0.0\n4.4, 2e-4\n4.8, -1e-4\n5.2, 1e-4\n")
    values = FLAT | {"rail_irregularity": str(rail), "flat.rolled": True, "flat.depth": 4e-4}
    values |= {f"wheel[{i}].out_of_roundness": str(tread) for i in (1, 2)}
    pair = contact_pair(short_track, values=values)
    pair.start(np.array([4.45, 2.65]), np.zeros(2))
    for k in range(150):
        positions = np.array([4.45, 2.65]) + SPEED * 1e-4 * k
        pair.step(1e-4, positions, np.zeros(2), linear=False)
    assert_alike(pair.outputs())


def test_wheels_that_are_continued_beyond_the_end_stay_at_it(contact_pair, short_track):
    pair = contact_pair(short_track, values=FLAT)
    positions = np.array([short_track.length - 5e-4, 3.0])
    pair.start(positions, np.zeros(2))
    pair.step(1e-4, positions, np.zeros(2), linear=False)
    assert_alike(pair.states())


@pytest.mark.parametrize(
    ("group", "values", "message"),
    [
        ("wheel[#].position", [4.5, 8.0], "position 8 m lies outside the track of 0 to 7.8 m"),
        ("wheel[#].position", [np.nan, 2.7], "outside the track"),
        ("wheel[#].displacement", [0.0, np.inf], "wheel 2 must be a finite number"),
        ("wheel[#].displacement", [1e200, 0.0], "did not converge .* use a shorter step"),
    ],
)
@pytest.mark.parametrize("linear", [True, False])
def test_refused_steps_change_nothing(contact_pair, short_track, group, values, message, linear):
    pair = contact_pair(short_track, values=FLAT)
    pair.start(np.array([4.5, 2.7]), np.zeros(2))
    pair.native.set_group(group, values)
    before = pair.native.state
    with pytest.raises(DiscardedError, match=message):
        pair.native_step(3e-4, linear=linear)
    assert pair.native.reached == 0.0
    assert pair.native.state.tobytes() == before.tobytes()


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("ballast", "soft", "ballast is 'soft'; it must be"),
        ("static_wheel_load", -1.0, "static_wheel_load = -1 N must be a finite number, at least 0"),
        ("wheel_radius", 0.0, "wheel_radius is 0 m"),
        ("hertz_coefficient", np.nan, "hertz_coefficient is nan"),
        ("flat.wheel", 3, "on wheel 3, the vehicle has 2"),
        ("flat.shape", "square", "one of none, haversine"),
        ("rail_irregularity", "missing.csv", "missing.csv: cannot be read"),
    ],
)
def test_bad_parameters_are_refused(native, name, value, message):
    track = native("track_contact")
    track.set_one(name, value)
    with pytest.raises(NativeError, match=message):
        track.enter()


@pytest.mark.parametrize("step", [1e-4, 3e-4])
@pytest.mark.parametrize("moved", [0.0, 1e-3])
def test_doubts_are_those_of_the_numpy_model(contact_pair, short_track, step, moved):
    """A long first step and a vehicle that has moved before it."""
    pair = contact_pair(short_track, values=FLAT)
    pair.start(np.array([4.5, 2.7]), np.zeros(2))
    positions = np.array([4.5, 2.7]) + moved
    doubts = pair.numpy.doubts(step, positions)
    assert len(doubts) == (step > 2e-4) + (moved > 0.0)
    pair.set(positions, np.zeros(2))
    pair.native_step(step, linear=False)
    assert pair.native.warning == "; ".join(doubts)
    pair.native_step(step, linear=False)
    assert pair.native.warning == ""
