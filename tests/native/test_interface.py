"""What a host sees of a native model: variables, phases, derivatives."""

import numpy as np
import pytest

from fmu_src.python.masses_variables import declare_masses
from fmu_src.python.model_slave import LINEAR_INPUTS
from fmu_src.python.track_contact_variables import declare_track_contact
from fmu_src.python.track_variables import declare_track
from fmu_src.python.vehicle_variables import declare_vehicle

from .derivatives import check_derivative
from .library import (
    CONSTANT,
    HELD,
    INPUT,
    OUTPUT,
    PARAMETER,
    REAL,
    STRAIGHT,
    TEXT,
    TYPES,
    NativeError,
)
from .twins import assert_alike

STATIC_LOAD = 117_720.0
SPEED = 40.0 / 3.6
CAUSALITIES = {CONSTANT: "parameter", PARAMETER: "parameter", INPUT: "input", OUTPUT: "output"}


@pytest.mark.parametrize("model", ["track", "vehicle", "track_contact", "masses"])
def test_variables_are_those_of_the_python_fmu(native, short_track, model):
    """Names, types, causalities and start values, in the same order: the same references."""
    declared = {
        "track": lambda: [*declare_track(short_track, wheels=2, gauges=2), LINEAR_INPUTS],
        "vehicle": lambda: [*declare_vehicle(2), LINEAR_INPUTS],
        "track_contact": lambda: declare_track_contact(short_track, wheels=2, gauges=2),
        "masses": lambda: declare_masses(2),
    }[model]()
    instance = native(model)
    assert instance.names == [variable.name for variable in declared]
    for group in instance.groups:
        for index in range(group.count):
            variable = declared[group.first + index]
            assert variable.causality == CAUSALITIES[group.causality]
            assert TYPES[type(variable.start)] == group.type
            if group.causality == OUTPUT:
                continue
            if group.type == TEXT:
                assert instance.text(variable.name) == variable.start
            else:
                assert instance.get([variable.name], group.type) == [float(variable.start)]


def test_calls_out_of_order_are_refused(native):
    track = native("track")
    with pytest.raises(NativeError, match="after it has begun"):
        track.exit()
    with pytest.raises(NativeError, match="after the initialisation"):
        track.step(0.0, 1e-3)
    with pytest.raises(NativeError, match="start time is nan"):
        track.enter(np.nan)
    track.enter()
    with pytest.raises(NativeError, match="begun already"):
        track.enter()
    track.exit()
    with pytest.raises(NativeError, match="fixed once the initialisation has ended"):
        track.set(initial_speed=3.0)
    with pytest.raises(NativeError, match="cannot be set"):
        track.set_group("pad[#].force", np.zeros(11))


def test_parameters_may_be_set_until_the_initialisation_ends(native):
    """Hosts such as libcosim set them in initialisation mode, as the standard allows."""
    before, during = native("vehicle"), native("vehicle")
    values = {"static_wheel_load": 90e3, "initial_position": 5.0, "flat.shape": "parabola"}
    before.set(**values)
    before.enter()
    during.enter()
    assert during.group("wheel[#].position")[0] != 5.0
    during.set(**values)
    for vehicle in (before, during):
        vehicle.exit()
        vehicle.step(0.0, 1e-4)
    assert during.group("wheel[#].contact_force")[0] == pytest.approx(90e3, rel=0.1)
    for name in ("wheel[#].position", "wheel[#].contact_force", "wheel[#].displacement"):
        assert during.group(name).tobytes() == before.group(name).tobytes()
    wrong = native("vehicle")
    wrong.enter()
    wrong.set(speed=-1.0)
    with pytest.raises(NativeError, match="speed"):
        wrong.exit()


def test_wrong_variables_are_refused(native):
    track = native("track")
    one = np.array([len(track.names)], dtype=np.uint32)
    value = np.zeros(1)
    assert track.library.rc_get(track.handle, REAL, one.ctypes.data, 1, value.ctypes.data) == 2
    assert "there is no variable" in track.message
    with pytest.raises(NativeError, match="is a Integer, not a Real"):
        track.get(["mode_pairs"])
    with pytest.raises(NativeError, match="is a String, not a Real"):
        track.get(["ballast"])


def test_outputs_follow_the_inputs_during_initialisation(native):
    track = native("track")
    assert track.get(["wheel[1].rail_displacement"]) == [0.0]
    track.enter()
    track.set_group("wheel[#].contact_force", [STATIC_LOAD, 0.0])
    loaded = track.get(["wheel[1].rail_displacement"])
    track.set_group("wheel[#].contact_force", [0.5 * STATIC_LOAD, 0.0])
    half = track.get(["wheel[1].rail_displacement"])
    assert 0.5 * loaded < half < loaded  # ballast that stiffens


def test_an_equilibrium_that_is_none(native):
    track = native("track")
    track.enter()
    track.set_group("wheel[#].position", [-1.0, 2.0])
    with pytest.raises(NativeError, match="outside the track"):
        track.exit()
    track.set_group("wheel[#].position", [4.0, 2.0])
    track.exit()


@pytest.mark.parametrize("linear", [True, False])
@pytest.mark.parametrize(
    ("quantity", "size", "step", "agreement"),
    [
        ("contact_force", 30.0, 2e-4, 1e-6),  # closed form; differences of 30 N are good to that
        ("contact_force", 30.0, 1.2e-3, 1e-6),  # a step that is divided
        ("position", 1e-5, 2e-4, 1e-6),
    ],
)
def test_derivatives_of_the_track(native, linear, quantity, size, step, agreement):
    track = native("track", linear_inputs=linear, initial_speed=SPEED)
    track.enter()
    track.set_group("wheel[#].position", [4.5, 2.75])
    track.exit()
    track.set_group("wheel[#].position", np.array([4.5, 2.75]) + SPEED * step)
    track.set_group("wheel[#].contact_force", [1.5 * STATIC_LOAD, 0.9 * STATIC_LOAD])
    unknowns = [
        track.names[i]
        for group in track.groups
        if group.causality == OUTPUT
        for i in range(group.first, group.first + group.count)
    ]
    knowns = [f"wheel[{i}].{quantity}" for i in (1, 2)]
    check_derivative(
        track, knowns, [1.0, -0.4], unknowns, step=step, size=size, agreement=agreement
    )


@pytest.mark.parametrize("linear", [True, False])
def test_derivatives_of_the_vehicle(native, linear):
    vehicle = native("vehicle", linear_inputs=linear, initial_position=16.55)
    vehicle.enter()
    vehicle.set_group("wheel[#].rail_displacement", [1e-3, 1.1e-3])
    vehicle.exit()
    vehicle.set_group("wheel[#].rail_displacement", [1.02e-3, 1.1e-3])
    unknowns = [
        f"wheel[{i}].{name}"
        for i in (1, 2)
        for name in ("contact_force", "displacement", "velocity", "gap")
    ]
    knowns = [f"wheel[{i}].rail_displacement" for i in (1, 2)]
    check_derivative(vehicle, knowns, [1.0, 0.5], unknowns, step=3e-4, size=1e-8, agreement=1e-6)


def test_derivatives_need_a_step(native):
    vehicle = native("vehicle")
    vehicle.enter()
    vehicle.exit()
    arguments = ["wheel[1].gap"], ["wheel[1].rail_displacement"], [1.0]
    with pytest.raises(NativeError, match="derivatives are those of the last step"):
        vehicle.derivative(*arguments)
    vehicle.step(0.0, 1e-4)
    vehicle.derivative(*arguments)
    with pytest.raises(NativeError, match="is no Real input"):
        vehicle.derivative(["wheel[1].gap"], ["speed"], [1.0])
    with pytest.raises(NativeError, match="is no Real output"):
        vehicle.derivative(["speed"], ["wheel[1].rail_displacement"], [1.0])
    vehicle.state = vehicle.state
    with pytest.raises(NativeError, match="restored"):
        vehicle.derivative(*arguments)


def real_outputs(model):
    for group in model.groups:
        if group.causality == OUTPUT and group.type == REAL:
            name = group.name.decode()
            yield name.rpartition(".")[2], model.group(name)


def assert_same_outputs(expected, found):
    assert_alike(
        (name, values, other)
        for (name, values), (_, other) in zip(
            real_outputs(expected), real_outputs(found), strict=True
        )
    )


@pytest.fixture
def moving(native):
    """Makes equal instances in the middle of a run, and their next inputs."""

    def make(model):
        values = {"track": {"initial_speed": SPEED}, "vehicle": {"initial_position": 16.55}}
        ends = {
            "track": {"position": [4.53, 2.73], "contact_force": [1.5e5, 0.8e5]},
            "vehicle": {"rail_displacement": [1.2e-3, 0.9e-3]},
        }[model]
        one = native(model, **values[model])
        one.enter()
        if model == "track":
            one.set_group("wheel[#].position", [4.5, 2.7])
        one.exit()
        one.step(0.0, 3e-4)
        return one, {f"wheel[#].{name}": np.array(end) for name, end in ends.items()}

    return make


def set_all(model, values):
    for group, value in values.items():
        model.set_group(group, value)


@pytest.mark.parametrize("model", ["track", "vehicle"])
@pytest.mark.parametrize("step", [2e-4, 1.3e-3])
def test_held_inputs_are_a_jump_and_a_level_line(moving, model, step):
    held, ends = moving(model)
    jumped, _ = moving(model)
    for instance in (held, jumped):
        set_all(instance, ends)
    held.step(held.time, step, HELD)
    jumped.jump()
    jumped.step(jumped.time, step, STRAIGHT)
    assert_same_outputs(held, jumped)


@pytest.mark.parametrize("model", ["track", "vehicle"])
def test_a_jump_to_where_the_inputs_are_changes_nothing(moving, model):
    one, _ = moving(model)
    other, _ = moving(model)
    other.jump()
    assert other.time == one.time
    assert_same_outputs(one, other)


def test_the_parameter_is_the_shape_of_steps_that_name_none(native):
    for linear, shape in ((False, HELD), (True, STRAIGHT)):
        results = []
        for named in (False, True):
            vehicle = native("vehicle", linear_inputs=linear != named)
            vehicle.enter()
            vehicle.exit()
            vehicle.set_group("wheel[#].rail_displacement", [1e-3, 0.0])
            vehicle.step(0.0, 1e-3, *([shape] if named else []))
            results.append(vehicle.group("wheel[#].displacement").tobytes())
        assert results[0] == results[1]


def test_jumps_that_are_refused(native, moving):
    with pytest.raises(NativeError, match="after the initialisation"):
        native("vehicle").jump()
    for model, group in (("track", "contact_force"), ("vehicle", "rail_displacement")):
        one, _ = moving(model)
        one.set_group(f"wheel[#].{group}", [np.nan, 0.0])
        before = one.state
        with pytest.raises(NativeError, match="finite number"):
            one.jump()
        assert one.state.tobytes() == before.tobytes()
