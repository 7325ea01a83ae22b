"""The native suspended vehicle agrees with the numpy one, on either side of the contacts."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fmu_src.native.model_resources import masses_resource, vehicle_resource

from .derivatives import check_derivative
from .library import REAL, DiscardedError, NativeError
from .twins import assert_alike, put_dynamic

LOAD = 80e3
COACH = {
    "model": "suspended",
    "static_wheel_load": LOAD,
    **{f"wheel[{i}].offset": offset for i, offset in ((2, 2.56), (3, 19.0), (4, 21.56))},
}
STOPS = {
    "primary.rebound_ratio": 2.5,
    "primary.clearance": 1e-4,
    "primary.stop_stiffness": 4e6,
    "secondary.clearance": -2e-4,
    "secondary.stop_stiffness": 1e6,
    "bogie[2].mass": 1500.0,
    "car.mass": 12e3,
}
TREAD = {"tread.mass": 250.0, "tread.stiffness": 9e8, "tread.damping": 2e3}
KINDS = {
    "linear": COACH,
    "stops": COACH | STOPS,
    "flexible": COACH | STOPS | TREAD,
    "flexible masses": COACH | TREAD | {"model": "masses"},
}
SIZE = {"wheels": 4, "bogies": 2}
N = 14  # coordinates

kinds = st.sampled_from(sorted(KINDS))
steps = st.floats(-5.5, -3.0).map(lambda exponent: 10.0**exponent)
seeds = st.integers(0, 2**32 - 1)
many = settings(
    max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


@pytest.fixture(scope="module")
def sized():
    return {"vehicle": vehicle_resource(**SIZE), "masses": masses_resource(**SIZE)}


def motion(random, kind, count):
    """Random coordinates and rates of what can move."""
    moving = np.ones(count)
    if "tread.mass" not in KINDS[kind]:
        moving[count - 10 : count - 6] = 0.0  # the hubs
    if KINDS[kind]["model"] == "masses":
        moving[-6:] = 0.0
    return 5e-4 * random.normal(size=count) * moving, 0.1 * random.normal(size=count) * moving


@many
@given(kind=kinds, step=steps, seed=seeds, linear=st.booleans(), past=st.floats(-0.06, 20.0))
def test_step_of_the_vehicle_from_random_states(
    vehicle_pair, sized, kind, step, seed, linear, past
):
    random = np.random.default_rng(seed)
    pair = vehicle_pair(
        sized["vehicle"], **SIZE, linear=linear, values=KINDS[kind] | {"initial_position": 12.0}
    )
    pair.start(0.25, np.zeros(4))
    rail = random.uniform(-1e-3, 3e-3, 4)
    origin = rail + random.uniform(0.0, 2e-4, 4)
    above, above_rate = motion(random, kind, N - 4)
    displaced, rate = 1e-4 * random.normal(size=4), 0.1 * random.normal(size=4)
    time = 0.25 + (16.6 - 12.0 + past) / (40.0 / 3.6)
    state = [0.25, time, *(origin + displaced), *rate, *rail, *origin, *above, *above_rate]
    pair.copy_state(np.array(state))
    assert_alike(pair.outputs())
    pair.step(step, rail + 1e-4 * random.normal(size=4))
    assert_alike(pair.outputs())
    flags = pair.native.group("wheel[#].in_contact")
    assert (flags == pair.numpy.in_contact).all()


@many
@given(
    kind=kinds, step=steps, seed=seeds, linear=st.booleans(),
    passed=st.sampled_from([0.0, 1e-4, 7e-4]),
)  # fmt: skip
def test_step_of_the_masses_from_random_states(
    masses_pair, sized, kind, step, seed, linear, passed
):
    random = np.random.default_rng(seed)
    pair = masses_pair(sized["masses"], **SIZE, values=KINDS[kind])
    pair.start(0.25, np.full(4, LOAD))
    above, above_rate = motion(random, kind, N - 4)
    wheels = (1e-4 * random.normal(size=4), 0.1 * random.normal(size=4))
    forces, slopes = LOAD * random.uniform(0.0, 3.0, 4), 1e7 * random.normal(size=4)
    ahead = [*wheels[0], *above, *wheels[1], *above_rate]
    state = [0.25, 0.75, passed, *wheels[0], *wheels[1], *forces, *slopes, *above, *above_rate]
    origin, change = 1e-3 * random.normal(size=4), LOAD * random.uniform(-0.5, 0.5, 4)
    pair.copy_state(np.array([*state, *ahead, *origin, *change]))
    assert_alike(pair.outputs())
    pair.step(step, LOAD * random.uniform(0.0, 3.0, 4), linear=linear)
    assert_alike(pair.outputs())


@pytest.mark.parametrize("kind", sorted(KINDS))
def test_passage_of_the_vehicle_over_a_flat(vehicle_pair, sized, kind):
    pair = vehicle_pair(sized["vehicle"], **SIZE, values=KINDS[kind] | {"initial_position": 16.5})
    random = np.random.default_rng(3)
    rail = np.full(4, 1e-3)
    pair.start(0.0, rail)
    assert_alike(pair.outputs())
    for _ in range(100):
        rail = rail + 1e-5 * random.normal(size=4)
        pair.step(random.choice([3e-5, 2e-4]), rail)
    assert_alike(pair.outputs(), parts=100)
    assert np.ptp(pair.native.group("wheel[#].contact_force")) > 1e3


@pytest.mark.parametrize("kind", sorted(KINDS))
@pytest.mark.parametrize(
    ("model", "group", "scale"),
    [("masses", "contact_force", LOAD), ("vehicle", "rail_displacement", 1e-4)],
)
def test_all_goes_on_bit_for_bit_from_a_serialised_state(native, sized, kind, model, group, scale):
    def go_on(model):
        for k in range(20):
            model.set_group(f"wheel[#].{group}", scale * random[k])
            model.step(model.time, 1e-4)
        outputs = [group.name.decode() for group in model.groups if group.causality == 3]
        return b"".join(model.group(name).tobytes() for name in outputs)

    random = np.random.default_rng(8).uniform(0.0, 2.0, (20, 4))
    one, other = native(model, sized[model]), native(model, sized[model])
    for name, value in KINDS[kind].items():
        one.set_one(name, value)
    one.enter()
    one.exit()
    go_on(one)
    saved = one.state
    expected = go_on(one)
    other.state = other.deserialise(one.serialise(saved))
    one.state = saved
    assert go_on(one) == go_on(other) == expected


@pytest.mark.parametrize(
    ("kind", "kinks"), [("linear", 1.0), ("flexible masses", 1.0), ("flexible", 3e3)]
)
@pytest.mark.parametrize("linear", [True, False])
def test_derivatives_by_all_wheels(native, sized, kind, kinks, linear):
    """Of dampers that are harder in rebound, at rest, there are two: differences lie in between."""
    vehicle = native("vehicle", sized["vehicle"], linear_inputs=linear)
    masses = native("masses", sized["masses"], linear_inputs=linear)
    for model, group, value, size, agreement in (
        (vehicle, "rail_displacement", 1e-3, 3e-8, 1e-6),
        (masses, "contact_force", LOAD, 1e4, 1e-8),
    ):
        for name, start in KINDS[kind].items():
            model.set_one(name, start)
        model.enter()
        model.set_group(f"wheel[#].{group}", [value] * 4)
        model.exit()
        knowns = [f"wheel[{i}].{group}" for i in (1, 2, 3, 4)]
        unknowns = [
            name
            for g in model.groups
            if g.causality == 3 and g.type == REAL and b"position" not in g.name
            for name in model.names[g.first : g.first + g.count]
        ]
        check_derivative(
            model, knowns, [1.0, 0.5, -0.2, 0.0], unknowns, step=3e-4, size=size,
            agreement=kinks * agreement,
        )  # fmt: skip


@pytest.mark.parametrize("model", ["vehicle", "masses"])
@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"model": "train"}, "model is 'train'; it must be one of masses, suspended"),
        ({"model": "suspended", "static_wheel_load": 9e3}, "the static wheel loads carry"),
        ({"model": "suspended", "car.mass": 1e6}, "raise static_wheel_load"),
        ({"model": "suspended", "car.mass": -1.0}, "car.mass is -1 kg"),
        ({"model": "suspended", "car.pitch_inertia": 0.0}, "car.pitch_inertia is 0 kg m2"),
        ({"model": "suspended", "bogie[1].mass": 0.0}, r"bogie\[1\].mass is 0 kg"),
        ({"model": "suspended", "primary.stiffness": -1.0}, "stiffness is -1 N/m"),
        ({"model": "suspended", "secondary.clearance": np.nan}, "clearance is nan m"),
        ({"model": "suspended", "primary.rebound_ratio": -1.0}, "rebound_ratio is -1; it"),
        ({"tread.mass": 592.5, "tread.stiffness": 1e9}, "tread.mass is 592.5 kg; it must be below"),
        ({"tread.mass": 100.0}, "tread.stiffness is 0 N/m"),
        ({"tread.mass": -1.0}, "tread.mass is -1 kg"),
        (
            {"tread.mass": 250.0, "tread.stiffness": 1e12},
            "acts within 1.20214e-05 s, the substep is",
        ),
        ({"model": "suspended", "primary.damping": 3e7}, "make it shorter, or springs and dampers"),
        ({"model": "suspended", "secondary.stop_stiffness": 1e13}, "or springs and dampers softer"),
        ({"model": "suspended", "substep": 0.1}, "acts within .* s, the substep is 0.1 s"),
    ],
)
def test_vehicles_that_cannot_be_are_refused_alike(
    native, vehicle_pair, masses_pair, model, values, message
):
    instance = native(model)
    for name, value in values.items():
        instance.set_one(name, value)
    with pytest.raises(NativeError, match=message):
        instance.enter()
    with pytest.raises(ValueError, match=message):
        {"vehicle": vehicle_pair, "masses": masses_pair}[model](values=values)


def test_refused_steps_change_nothing(vehicle_pair, masses_pair, sized):
    vehicle = vehicle_pair(sized["vehicle"], **SIZE, values=COACH)
    masses = masses_pair(sized["masses"], **SIZE, values=COACH | {"linear_inputs": True})
    vehicle.start(0.0, np.zeros(4))
    masses.start(0.0, np.full(4, LOAD))
    for pair, group, value, message in (
        (vehicle, "rail_displacement", -1e300, "shorter step"),
        (masses, "contact_force", 1e308, "out of the range of numbers"),
    ):
        pair.native.set_group(f"wheel[#].{group}", [value] * 4)
        before = pair.native.state
        with pytest.raises(DiscardedError, match=message):
            pair.native.step(0.0, 1e-4 if pair is vehicle else 1e-2)
        assert pair.native.state.tobytes() == before.tobytes()


def test_a_state_of_rigid_masses_leaves_the_bodies_at_rest(native, sized):
    """A block of the same build, whichever model it was saved by: the parameters are in it."""
    model = native("masses", sized["masses"])
    model.enter()
    model.exit()
    rigid = model.state
    put_dynamic(model, 3 + 4 * 4 + 4 * N, rigid[-(3 + 4 * 4 + 4 * N) :])
    model.step(0.0, 1e-3)
    assert not model.group("car.displacement").any()
    assert not model.group("primary[#].force").any()
