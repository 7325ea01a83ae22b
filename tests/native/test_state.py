"""Going back to a state repeats everything bit for bit, in the same instance and in another."""

import numpy as np
import pytest

from .library import NativeError

STATIC_LOAD = 117_720.0
SPEED = 40.0 / 3.6


@pytest.fixture
def track(native):
    def make():
        track = native("track", linear_inputs=True, initial_speed=SPEED)
        track.enter()
        track.set_group("wheel[#].position", [4.5, 2.7])
        track.exit()
        return track

    return make


def outputs(model):
    return [
        model.group(group.name.decode()).tobytes() for group in model.groups if group.causality == 3
    ]


def walk(track, steps, seed):
    """Steps of many sizes; everything that is seen on the way."""
    random = np.random.default_rng(seed)
    seen = []
    for _ in range(steps):
        step = random.choice([2e-5, 1e-4, 3.3e-4, 7e-4])
        track.set_group("wheel[#].position", track.group("wheel[#].position") + SPEED * step)
        track.set_group("wheel[#].contact_force", STATIC_LOAD * random.uniform(0.5, 1.5, 2))
        track.step(track.time, step)
        seen += outputs(track)
    return [*seen, track.state.tobytes()]


def test_track_repeats_itself(track):
    one = track()
    walk(one, 5, seed=1)
    saved = one.state
    first = walk(one, 20, seed=2)
    walk(one, 50, seed=3)  # more step sizes and supports than are remembered
    one.state = saved
    assert walk(one, 20, seed=2) == first


def test_a_repeated_step_does_not_depend_on_what_was_tried(track):
    one, other = track(), track()
    saved = one.state
    for force in (1e5, 3e5, 0.0):
        one.state = saved
        one.set_group("wheel[#].contact_force", [force, STATIC_LOAD])
        one.step(0.0, 1e-4)
    one.state = saved
    assert walk(one, 3, seed=5) == walk(other, 3, seed=5)


def test_more_step_sizes_than_are_remembered(track):
    one, other = track(), track()
    saved = one.state
    for k in range(100):
        one.state = saved
        one.step(0.0, 1e-4 * (1.0 + 1e-3 * k))
    one.state = saved
    assert walk(one, 3, seed=5) == walk(other, 3, seed=5)


def test_serialised_state_in_another_instance(track, native):
    one = track()
    walk(one, 10, seed=1)
    data = one.serialise(one.state)
    fresh = native("track")  # neither initialised nor given the parameters
    fresh.state = fresh.deserialise(data)
    assert fresh.serialise(fresh.state) == data
    assert walk(fresh, 10, seed=2) == walk(one, 10, seed=2)


def test_vehicle_state_with_its_tables(native, tmp_path):
    path = tmp_path / "rail.csv"
    path.write_text("12 0\n12.5 1e-4\n13 0\n14 0\n")
    round_the_wheel = tmp_path / "tread.csv"
    round_the_wheel.write_text("0 0\n1 1e-4\n2 0\n5 0\n")
    tread = {"wheel[2].out_of_roundness": str(round_the_wheel)}
    one = native("vehicle", rail_irregularity=str(path), flat__shape="cusp", **tread)
    one.enter()
    one.exit()
    one.step(0.0, 1e-3)
    data = one.serialise(one.state)
    other = native("vehicle")
    other.state = other.deserialise(data)
    for model in (one, other):
        model.step(1e-3, 2e-2)
    assert outputs(one) == outputs(other)
    path.unlink()
    third = native("vehicle")
    with pytest.raises(NativeError, match="cannot be read"):
        third.state = third.deserialise(data)
    third.set(rail_irregularity="")
    third.enter()


def test_state_before_the_initialisation(native):
    track = native("track", supports_per_wheel=3)
    saved = track.state
    track.set(supports_per_wheel=4)
    track.enter()
    track.exit()
    track.state = saved
    assert bytes(track.state) == bytes(saved)
    track.set(supports_per_wheel=5)  # a parameter may be set again: nothing is initialised
    track.enter()


def test_reset(track):
    one, other = track(), track()
    walk(one, 5, seed=1)
    one.library.rc_reset(one.handle)
    one.set(linear_inputs=True, initial_speed=SPEED)
    one.enter()
    one.set_group("wheel[#].position", [4.5, 2.7])
    one.exit()
    assert walk(one, 5, seed=2) == walk(other, 5, seed=2)


def test_damaged_states_are_refused(track):
    one = track()
    data = one.serialise(one.state)
    before = one.state.tobytes()
    random = np.random.default_rng(0)
    damaged = [b"", data[:10], data[:-1], data + b"\0", b"X" + data[1:]]
    for place in random.integers(0, len(data), 200):
        altered = bytearray(data)
        altered[place] ^= int(random.integers(1, 256))
        damaged.append(bytes(altered))
    for bad in damaged:
        with pytest.raises(NativeError, match=r"serialised state|another build"):
            one.deserialise(bad)
    assert one.state.tobytes() == before


def test_states_of_other_models_are_refused(track, native):
    vehicle = native("vehicle")
    with pytest.raises(NativeError, match="another build"):
        track().deserialise(vehicle.serialise(vehicle.state))
