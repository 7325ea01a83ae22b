"""Tracks and vehicles of every make: valid, and back at a state they repeat everything bit for bit.

States are saved where they hold what is special about a make: a window that has moved, a pad that
relaxes, a lifted or a bent sleeper, a closed bump stop.
"""

import numpy as np
import pytest
from fmpy import extract
from fmpy.validation import validate_fmu

from fmu_src.building import ensure_fmus, ensure_native_fmus
from fmu_src.structure import Structure
from orchestrator import check_fmu

from .fmi_calls import OK, Calls
from .makes import MAKES, values_of

STEP = 2e-4  # s
STEPS = 80  # the window of twelve bays moves after 68 of them, and every 130 from then on
KINDS = ("fmi2", "fmi3", pytest.param("python", marks=pytest.mark.slow))

OF_OTHER_SIZE = ("three wheels", "beams", "manchester_coach")
CLAIMING = (*OF_OTHER_SIZE, "endless supports", "rich")


@pytest.fixture(scope="module")
def supports(tmp_path_factory):
    """A table of 16000 supports, every one of its own kind."""
    path, random = tmp_path_factory.mktemp("tables") / "supports.csv", np.random.default_rng(1)
    lines = ["number,pad_stiffness_factor,ballast_stiffness_factor,gap,sleeper_mass_factor"]
    lines += [
        f"{k},{a:.4f},{b:.4f},{2e-4 * (k % 5 == 0)},{0.5 + a / 2:.4f}"
        for k, (a, b) in enumerate(random.uniform(0.5, 2.0, (16_000, 2)), start=1)
    ]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return str(path)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("structures")


@pytest.fixture(scope="module")
def path_of(folder):
    """Return a function that builds the FMU of a make."""

    def find(make, kind):
        structure = Structure(**({"bays": 12, "elements_per_bay": 4, "gauges": 1} | make.structure))
        if kind == "python":
            pair = ensure_fmus(folder, structure, contact=make.contact)
        else:
            pair = ensure_native_fmus(
                folder, structure, contact=make.contact, fixed=make.fixed, fmi_version=int(kind[-1])
            )
        return getattr(pair, make.side)

    return find


@pytest.fixture
def opened(path_of, tmp_path):
    """Return a function that makes instances of a make, and frees them at the end."""
    made = []

    def instance(make, kind):
        one = Calls(extract(str(path_of(make, kind)), unzipdir=tmp_path / str(len(made))))
        made.append(one)
        return one

    yield instance
    for one in made:
        one.free()


def put_inputs(instance, make, time):
    for wheel in range(1, make.wheels + 1):
        for name, value in make.inputs(wheel, time).items():
            instance.must(instance.put(name, float(value)))


def drive(instance, make, first, last):
    """Steps by number; all outputs after each."""
    seen = []
    for n in range(first, last):
        put_inputs(instance, make, (n + 1) * STEP)
        status, _ = instance.step(n * STEP, STEP)
        assert status == OK, instance.messages
        seen += instance.get(*instance.outputs)
    return np.array(seen).tobytes()


def outputs_of(instance):
    return dict(zip(instance.outputs, instance.get(*instance.outputs), strict=True))


def named(instance):
    """Its Real outputs."""
    items = instance.description.modelVariables
    instance.outputs = [
        item.name
        for item in items
        if item.causality == "output" and item.type in {"Real", "Float64"} and not item.dimensions
    ]
    return instance


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", MAKES)
def test_a_state_is_restored_and_serialised_in_the_middle(opened, supports, name, kind):
    make = MAKES[name]
    one = named(opened(make, kind))
    values = values_of(make, kind, supports) | {"linear_inputs": True}
    for key, value in values.items():
        one.must(one.put(key, value))
    put_inputs(one, make, 0.0)
    one.start()
    first = outputs_of(one)
    drive(one, make, 0, STEPS)
    assert make.seen(first, outputs_of(one))
    state = one.save()
    data = one.serialise(state)
    expected = drive(one, make, STEPS, 2 * STEPS)
    one.must(one.call("SetFMUstate", state))
    one.must(one.step(STEPS * STEP, 0.3 * STEP)[0])  # a detour
    one.must(one.call("SetFMUstate", state))
    assert drive(one, make, STEPS, 2 * STEPS) == expected
    other = named(opened(make, kind))  # never initialised
    status, copy = other.deserialise(data)
    assert status == OK, other.messages
    other.must(other.call("SetFMUstate", copy))
    assert drive(other, make, STEPS, 2 * STEPS) == expected


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", [name for name in MAKES if name.startswith(OF_OTHER_SIZE)])
def test_archives_of_other_sizes_keep_to_the_standard(path_of, name, kind):
    assert validate_fmu(str(path_of(MAKES[name], kind))) == []


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", [name for name in MAKES if name.startswith(CLAIMING)])
def test_all_claims_hold(path_of, supports, name, kind):
    make = MAKES[name]
    values = values_of(make, kind, supports)
    verdicts = check_fmu(path_of(make, kind), step_size=STEP, start_values=values)
    assert [item for item in verdicts if not item.holds] == []
