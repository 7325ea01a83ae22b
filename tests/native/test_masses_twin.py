"""The native masses agree with the numpy model, which is their specification."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fmu_src.native.model_resources import masses_resource

from .library import DiscardedError, NativeError
from .twins import assert_alike

LOAD = 117_720.0

steps = st.floats(-6.0, -1.0).map(lambda exponent: 10.0**exponent)
pairs = st.tuples(*[st.floats(0.0, 4.0 * LOAD)] * 2)


@settings(
    max_examples=100, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(
    step=steps,
    linear=st.booleans(),
    passed=st.sampled_from([0.0, 1e-4, 3e-3]),
    speed=st.floats(1.0, 80.0),
    offset=st.floats(-20.0, 20.0),
    displacements=st.tuples(*[st.floats(-1e-3, 1e-3)] * 2),
    velocities=st.tuples(*[st.floats(-0.5, 0.5)] * 2),
    slopes=st.tuples(*[st.floats(-1e8, 1e8)] * 2),
    before=pairs,
    forces=pairs,
)
def test_step_from_random_states(
    masses_pair,
    step,
    linear,
    passed,
    speed,
    offset,
    displacements,
    velocities,
    slopes,
    before,
    forces,
):
    pair = masses_pair(values={"speed": speed, "wheel[2].offset": offset})
    pair.start(0.25, np.full(2, LOAD))
    state = [0.25, 0.75, passed, *displacements, *velocities, *before, *slopes]
    pair.copy_state(np.array(state))
    assert_alike(pair.outputs())
    pair.step(step, np.array(forces), linear=linear)
    assert_alike(pair.outputs())
    np.testing.assert_allclose(
        pair.dynamic, pair.numpy.state, rtol=1e-12, atol=1e-12 * max(1e-3, step)
    )


@pytest.mark.parametrize("wheels", [1, 2, 6])
@pytest.mark.parametrize("linear", [True, False])
def test_any_number_of_wheels_and_a_table_of_speeds(masses_pair, tmp_path, wheels, linear):
    path = tmp_path / "speed.csv"
    path.write_text("time,speed\n0.0,10\n0.2,14\n0.5,11.5\n")
    values = {f"wheel[{i}].offset": 1.7 * i + 0.1 * i * i for i in range(2, wheels + 1)}
    pair = masses_pair(
        masses_resource(wheels=wheels), wheels=wheels,
        values=values | {"speed_table": str(path), "wheel_mass": 700.0},
    )  # fmt: skip
    pair.start(0.05, np.full(wheels, LOAD))
    random = np.random.default_rng(3)
    for _ in range(300):
        step = random.choice([3e-5, 2e-4, 1e-3])
        pair.step(step, LOAD * random.uniform(0.0, 2.0, wheels), linear=linear)
    assert_alike(pair.outputs())


def test_offsets_are_counted_from_the_second_wheel(native):
    masses = native("masses", masses_resource(wheels=3))
    offsets = [name for name in masses.names if name.endswith("offset")]
    assert offsets == ["wheel[2].offset", "wheel[3].offset"]
    assert masses.group("wheel[#].offset") == pytest.approx([1.8, 3.6])


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("wheel_mass", 0.0, "wheel_mass is 0 kg"),
        ("static_wheel_load", -1.0, "static_wheel_load is -1 N"),
        ("initial_position", np.inf, "initial_position is inf m"),
        ("wheel[2].offset", np.nan, "offset of wheel 2 is nan m"),
        ("speed", 0.0, "speed is 0 m/s"),
        ("speed_table", "missing.csv", "missing.csv: cannot be read"),
    ],
)
def test_bad_parameters_are_refused(native, name, value, message):
    masses = native("masses")
    masses.set_one(name, value)
    with pytest.raises(NativeError, match=message):
        masses.enter()


@pytest.mark.parametrize("linear", [True, False])
def test_refused_steps_change_nothing(masses_pair, linear):
    pair = masses_pair()
    pair.start(0.0, np.full(2, LOAD))
    before = pair.native.state
    with pytest.raises(DiscardedError, match="force of wheel 2 is nan N"):
        pair.step(1e-4, np.array([LOAD, np.nan]), linear=linear)
    after = pair.native.state
    inputs = slice(-pair.dynamic_size - 2, -pair.dynamic_size)
    after[inputs] = before[inputs]  # they are the host's
    pair.native.set_group("wheel[#].contact_force", np.full(2, LOAD))
    assert pair.native.state.tobytes() == before.tobytes()
