"""What a host sees of the native track with contacts and of the masses: shapes, derivatives."""

import numpy as np
import pytest

from .derivatives import check_derivative
from .library import HELD, OUTPUT, REAL, STRAIGHT, DiscardedError, NativeError
from .twins import assert_alike

LOAD = 117_720.0
SPEED = 40.0 / 3.6
START = np.array([4.5, 2.7])
STEP = 1e-4


def swing(time):
    """Another one for every wheel, from zero."""
    phase = np.array([0.0, 2.0])
    return np.sin(600.0 * time + phase) - np.sin(phase)


def tread(time):
    """Displacements of the wheels, small enough to keep contact [m]."""
    return 3e-5 * swing(time)


def press(time):
    """Contact forces on the wheels [N]."""
    return LOAD * (1.0 + 0.3 * swing(time))


class Track:
    """The native track with contacts, and inputs for it."""

    def __init__(self, native):
        self.model = native("track_contact", initial_speed=SPEED, flat__position=4.55)
        self.model.enter()
        self.model.set_group("wheel[#].position", START)
        self.model.exit()

    def set(self, time):
        self.model.set_group("wheel[#].position", START + SPEED * time)
        self.model.set_group("wheel[#].displacement", tread(time))


class Masses:
    """The native masses, and inputs for them."""

    def __init__(self, native):
        self.model = native("masses", initial_position=4.5)
        self.model.enter()
        self.model.exit()

    def set(self, time):
        self.model.set_group("wheel[#].contact_force", press(time))


def walk(one, steps, shape, *, first=0):
    """Steps of one shape; inputs are those at the times for which it takes them."""
    for k in range(first, first + steps):
        one.set(STEP * (k + (shape == STRAIGHT)))
        one.model.step(STEP * k, STEP, shape)


def outputs(model, kind=REAL):
    return [
        (group.name.decode().removeprefix("wheel[#]."), model.group(group.name.decode()))
        for group in model.groups
        if group.causality == OUTPUT and group.type == kind
    ]


def assert_same(one, other):
    rows = zip(outputs(one.model), outputs(other.model), strict=True)
    assert_alike((name, mine, theirs) for (name, mine), (_, theirs) in rows)


@pytest.fixture(params=[Track, Masses])
def make(native, request):
    return lambda: request.param(native)


# how inputs run over a step


def test_a_jump_and_straight_lines_are_straight_lines(make):
    """Inputs that are where the lines left them are no jump; derivatives of inputs are given so."""
    one, other = make(), make()
    one.set(0.0)
    other.set(0.0)
    one.model.jump()
    other.model.jump()
    walk(one, 10, STRAIGHT)
    for k in range(10):
        other.set(STEP * k)
        other.model.jump()
        walk(other, 1, STRAIGHT, first=k)
    assert_same(one, other)


def test_forces_are_continued_on_their_last_line(native):
    one, other = Masses(native), Masses(native)
    walk(one, 5, HELD)
    walk(other, 5, HELD)
    walk(one, 1, HELD, first=5)
    other.model.set_group("wheel[#].contact_force", press(5 * STEP))
    other.model.jump()
    other.model.set_group("wheel[#].contact_force", 2.0 * press(5 * STEP) - press(4 * STEP))
    other.model.step(5 * STEP, STEP, STRAIGHT)
    assert_same(one, other)


def test_the_shape_may_change_from_step_to_step(make):
    """What was continued and never told is taken for true: smooth inputs, second order."""
    errors = []
    for share in (1, 2):
        one, exact = make(), make()
        step = STEP / share
        for k in range(40 * share):
            shape = HELD if (k // 5) % 2 == 0 else STRAIGHT
            one.set(step * (k + (shape == STRAIGHT)))
            one.model.step(step * k, step, shape)
        for k in range(320):
            exact.set(STEP / 8 * (k + 1))
            exact.model.step(STEP / 8 * k, STEP / 8, STRAIGHT)
        found, wanted = (dict(outputs(side.model)) for side in (one, exact))
        name = "contact_force" if "contact_force" in wanted else "displacement"
        errors.append(np.max(np.abs(found[name] - wanted[name])) / np.max(np.abs(wanted[name])))
    assert errors[0] < 0.02
    assert errors[1] < 0.5 * errors[0]


def test_jumps_that_are_refused(make):
    one = make()
    walk(one, 2, HELD)
    group = one.model.groups[one.model.place["wheel[#].contact_force"]]
    name = "displacement" if group.causality == OUTPUT else "contact_force"
    one.model.set_group(f"wheel[#].{name}", [np.nan, 0.0])
    before = one.model.state
    with pytest.raises(NativeError, match="finite number"):
        one.model.jump()
    assert one.model.state.tobytes() == before.tobytes()


# states


@pytest.mark.parametrize("shape", [HELD, STRAIGHT])
def test_a_restored_state_repeats_itself_bit_for_bit(make, shape):
    one, other = make(), make()
    walk(one, 7, shape)
    saved = one.model.state
    walk(one, 20, shape, first=7)
    after = one.model.state
    for model in (one.model, other.model):
        model.state = model.deserialise(one.model.serialise(saved))
    for side in (one, other):
        walk(side, 20, shape, first=7)
        assert side.model.state.tobytes() == after.tobytes()
        for kind in (REAL, 2):
            mine = [values.tobytes() for _, values in outputs(side.model, kind)]
            assert mine == [values.tobytes() for _, values in outputs(one.model, kind)]


# derivatives


def all_outputs(model):
    return [
        model.names[i]
        for group in model.groups
        if group.causality == OUTPUT and group.type == REAL
        for i in range(group.first, group.first + group.count)
    ]


@pytest.mark.parametrize("linear", [True, False])
@pytest.mark.parametrize(
    ("quantity", "size", "step"),
    [("displacement", 2e-8, 1e-4), ("displacement", 2e-8, 5e-4), ("position", 2e-5, 1e-4)],
)
def test_derivatives_of_the_track(native, linear, quantity, size, step):
    """By differences of another size: both are good to 1e-6."""
    model = native("track_contact", linear_inputs=linear, initial_speed=SPEED, flat__position=4.55)
    model.enter()
    model.set_group("wheel[#].position", START)
    model.exit()
    for k in range(3):
        model.set_group("wheel[#].position", START + SPEED * step * (k + linear))
        model.set_group("wheel[#].displacement", [1e-5 * k, -2e-5 * k])
        model.step(model.time, step)
    model.set_group("wheel[#].position", START + SPEED * step * (3 + linear))
    model.set_group("wheel[#].displacement", [4e-5, -5e-5])
    unknowns = [name for name in all_outputs(model) if "static" not in name]
    knowns = [f"wheel[{i}].{quantity}" for i in (1, 2)]
    check_derivative(model, knowns, [1.0, -0.4], unknowns, step=step, size=size, agreement=1e-5)


@pytest.mark.parametrize("linear", [True, False])
@pytest.mark.parametrize("steps", [0, 3])
def test_derivatives_of_the_masses(native, linear, steps):
    """The motion is linear in the forces: exact, and differences of any size are."""
    model = native("masses", linear_inputs=linear)
    model.enter()
    model.exit()
    for k in range(steps):
        model.set_group("wheel[#].contact_force", press(STEP * k))
        model.step(model.time, STEP)
    unknowns = [f"wheel[{i}].{name}" for i in (1, 2) for name in ("displacement", "velocity")]
    knowns = [f"wheel[{i}].contact_force" for i in (1, 2)]
    check_derivative(model, knowns, [1.0, -0.4], unknowns, step=2e-4, size=1e5, agreement=1e-10)


def test_there_is_no_derivative_beyond_the_track(native):
    """Central differences would need wheels there; the instance goes on."""
    model = native("track_contact", linear_inputs=True)
    model.enter()
    model.set_group("wheel[#].position", [4.5, 0.0])
    model.exit()
    model.step(0.0, 1e-4)
    with pytest.raises(DiscardedError, match="lies outside the track"):
        model.derivative(["wheel[2].gap"], ["wheel[2].position"], [1.0])
    assert model.derivative(["wheel[1].gap"], ["wheel[1].position"], [1.0]).shape == (1,)
    model.step(1e-4, 1e-4)


def test_wheels_that_do_not_touch_press_on_nothing(native):
    model = native("track_contact", linear_inputs=True)
    model.enter()
    model.set_group("wheel[#].position", START)
    model.exit()
    model.set_group("wheel[#].displacement", [-5e-3, 0.0])
    model.step(0.0, 1e-4)
    model.step(1e-4, 1e-4)
    assert model.group("wheel[#].in_contact").tolist() == [0.0, 1.0]
    names = ["wheel[1].contact_force", "wheel[1].gap", "wheel[2].contact_force"]
    found = model.derivative(names, ["wheel[1].displacement"], [1.0])
    assert found == pytest.approx([0.0, -1.0, 0.0], abs=1e-6)
