"""The native vehicle agrees with the numpy model, which is its specification."""

import locale

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fmu_src.python.tables import read_table

from .library import BOOLEAN, DiscardedError, NativeError
from .twins import assert_alike

SPEED = 40.0 / 3.6
FLAT = 16.6
TABLES = {
    "profile": "# a worn flat\ndistance;drop\n-0.05;0\n-0.02;4e-4\n0.0;9e-4\n0.03;1e-4\n0.06;0\n",
    "raised": "\ufeff-0.05 0.0\n-0.03 -1e-4\n0.0 6e-4\n0.05 0.0\n",
    "speed": "time,speed\r\n0.0,10\r\n0.2,14\r\n0.5,11.5\r\n",
    "tread": "angle,drop\n0.4,1e-4\n1.3,-5e-5\n2.0,2e-4\n3.5,0\n6.2,1e-4\n",
    "rail": "15.0, 0.0\n15.9, 2e-4\n\n16.3, -1e-4\n17.5, 1e-4\n",
}


@pytest.fixture(scope="session")
def tables(tmp_path_factory):
    folder = tmp_path_factory.mktemp("tables")
    for name, text in TABLES.items():
        (folder / f"{name}.csv").write_bytes(text.encode())
    return {name: str(folder / f"{name}.csv") for name in TABLES}


shapes = st.sampled_from(["none", "haversine", "parabola", "cusp", "chord"])


@settings(
    max_examples=80, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(
    shape=shapes,
    wheel=st.integers(1, 2),
    periodic=st.booleans(),
    linear=st.booleans(),
    speed=st.floats(1.0, 80.0),
    substep=st.floats(2e-6, 1e-3),
    step=st.floats(-6.0, -2.7).map(lambda exponent: 10.0**exponent),
    past=st.floats(-0.06, 3.0),
    compressions=st.tuples(st.floats(-2e-4, 3e-4), st.floats(-2e-4, 3e-4)),
    velocities=st.tuples(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5)),
    rail=st.tuples(*[st.floats(-1e-3, 3e-3)] * 4),
)
def test_step_from_random_states(
    vehicle_pair,
    shape,
    wheel,
    periodic,
    linear,
    speed,
    substep,
    step,
    past,
    compressions,
    velocities,
    rail,
):
    values = {
        "flat.shape": shape,
        "flat.wheel": wheel,
        "flat.periodic": periodic,
        "speed": speed,
        "substep": substep,
        "initial_position": 12.0,
    }
    pair = vehicle_pair(linear=linear, values=values)
    pair.start(0.25, np.zeros(2))
    time = 0.25 + (FLAT - 12.0 + past) / speed
    before, after = np.array(rail[:2]), np.array(rail[2:])
    pair.copy_state(np.array([0.25, time, *(before + compressions), *velocities, *before]))
    assert_alike(pair.outputs())
    pair.step(step, after)
    assert_alike(pair.outputs())
    flags = pair.native.get(["wheel[1].in_contact", "wheel[2].in_contact"], BOOLEAN)
    assert (flags == pair.numpy.in_contact).all()


@pytest.mark.parametrize(
    ("flat", "rolled"),
    [("profile", False), ("raised", True), ("haversine", True), ("none", False)],
)
def test_tables_and_rolled_profiles(vehicle_pair, tables, flat, rolled):
    pair = vehicle_pair(
        values={
            "flat.shape": tables.get(flat, flat),
            "flat.rolled": rolled,
            "rail_irregularity": tables["rail"],
            "wheel[2].out_of_roundness": tables["tread"],
            "speed_table": tables["speed"],
            "initial_position": FLAT - 1.0,
        }
    )
    pair.start(0.05, np.array([1e-3, 1.2e-3]))
    assert_alike(pair.outputs())
    random = np.random.default_rng(3)
    for _ in range(300):
        pair.step(random.choice([3e-5, 2e-4, 1e-3]), random.uniform(0.5e-3, 1.5e-3, 2))
    assert_alike(pair.outputs())


@pytest.mark.parametrize("wheels", [(1,), (2,), (1, 2)])
def test_wheels_that_are_not_round(vehicle_pair, tables, wheels):
    treads = {f"wheel[{i}].out_of_roundness": tables["tread"] for i in wheels}
    pair = vehicle_pair(values=treads | {"initial_position": FLAT - 0.5, "speed": 20.0})
    pair.start(0.05, np.array([1e-3, 1.2e-3]))
    for _ in range(200):  # 4 m, more than a turn
        pair.step(1e-3, np.array([1e-3, 1.2e-3]))
        assert_alike(pair.outputs())


def test_comma_of_the_locale_does_not_matter(vehicle_pair, tables):
    """A host may have chosen a locale in which 0.5 is written 0,5."""
    before = locale.setlocale(locale.LC_NUMERIC)
    for name in ("de_DE.UTF-8", "de_DE", "fr_FR.UTF-8"):
        try:
            locale.setlocale(locale.LC_NUMERIC, name)
        except locale.Error:
            continue
        break
    else:
        pytest.skip("no locale with a decimal comma is installed")
    try:
        pair = vehicle_pair(values={"rail_irregularity": tables["rail"], "initial_position": 16.1})
        pair.start(0.0, np.zeros(2))
        assert_alike(pair.outputs())
    finally:
        locale.setlocale(locale.LC_NUMERIC, before)


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("wheel_mass", 0.0, "wheel_mass is 0 kg"),
        ("speed", -1.0, "speed is -1 m/s"),
        ("flat.shape", "square", "one of none, haversine"),
        ("flat.shape", "missing.csv", "missing.csv: cannot be read"),
        ("flat.depth", -1e-3, "flat depth is -0.001 m"),
        ("flat.depth", 0.9, "must leave a wheel"),
        ("flat.length", 9.0, "must fit on its wheel"),
        ("flat.wheel", 3, "on wheel 3, the vehicle has 2"),
        ("flat.wheel", 0, "counted from 1"),
        ("initial_position", np.nan, "must be a finite number"),
    ],
)
def test_bad_parameters_are_refused(native, name, value, message):
    vehicle = native("vehicle")
    vehicle.set_one(name, value)
    with pytest.raises(NativeError, match=message):
        vehicle.enter()


def test_texts_that_are_too_long_are_refused(native):
    with pytest.raises(NativeError, match="use a shorter path"):
        native("vehicle", speed_table="x" * 1024)


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("speed_table", "0 1\n1 2 3\n", "line 2"),
        ("speed_table", "0 1\n1 nan\n", "line 2"),
        ("speed_table", "t; v, m/s\n0;1,5\n1;2,5\n", "line 2: has both commas and semicolons"),
        ("speed_table", "0 1\n1 1e999\n", "line 2"),
        ("speed_table", "0 1\n0 2\n", "increase from point to point"),
        ("speed_table", "0 1\n", "at least 2 are needed"),
        ("speed_table", "", "at least 2 are needed"),
        ("speed_table", "0 1\n1 0\n", "must be above zero"),
        ("rail_irregularity", "0 1\n1 0\n2 0\n", "at least 4 are needed"),
        ("wheel[2].out_of_roundness", "0 1\n90 0\n180 0\n270 0\n", "below 2 pi: give radians"),
        ("wheel[2].out_of_roundness", "-1 1\n1 0\n2 0\n3 0\n", "must be at least 0"),
        ("wheel[1].out_of_roundness", "0 1\n1 0\n2 0\n", "at least 4 are needed"),
        ("flat.shape", "0 1e-3\n1e-2 2e-3\n2e-2 1e-3\n3e-2 0\n", "zero at both ends"),
        ("flat.shape", "0 0\n1e-2 -2e-3\n2e-2 0\n3e-2 0\n", "change the sign"),
    ],
)
def test_bad_tables_are_refused(native, tmp_path, name, text, message):
    path = tmp_path / "table.csv"
    path.write_text(text)
    vehicle = native("vehicle")
    vehicle.set_one(name, str(path))
    with pytest.raises(NativeError, match=message):
        vehicle.enter()


@pytest.mark.parametrize(
    "content",
    [
        b"0 1\n1 2\0\n2 3\n",
        b"0 1\n1 2\n\x002 3\n",
        b"# note\0\n0 1\n1 2\n",
        b"0 1\n1 2\n\0",
        "time speed\n0 1\n1 2\n".encode("utf-16-le"),
    ],
)
def test_tables_with_a_zero_byte_are_refused_alike(native, tmp_path, content):
    """They would be cut there without a word."""
    path = tmp_path / "table.csv"
    path.write_bytes(content)
    vehicle = native("vehicle")
    vehicle.set_one("speed_table", str(path))
    with pytest.raises(NativeError) as said:
        vehicle.enter()
    with pytest.raises(ValueError, match="is zero, which is no text") as also_said:
        read_table(path, ("time", "speed"))
    assert f"byte {content.index(0) + 1} is zero" in str(said.value)
    assert str(said.value) == str(also_said.value)


def test_refused_steps_change_nothing(vehicle_pair):
    pair = vehicle_pair()
    pair.start(0.0, np.zeros(2))
    for rail, message in (([np.nan, 0.0], "finite number"), ([-1e300, 0.0], "shorter step")):
        pair.native.set_group("wheel[#].rail_displacement", rail)
        before = pair.native.state
        with pytest.raises(DiscardedError, match=message):
            pair.native.step(0.0, 1e-4)
        assert pair.native.state.tobytes() == before.tobytes()
