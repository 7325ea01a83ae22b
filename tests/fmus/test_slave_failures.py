"""Slaves that are asked for what cannot be: honest answers, and the state stays."""

import pytest
from fmpy.fmi1 import FMICallException

from fmu_src.archive import write_archive
from fmu_src.python.packaging import fmu_contents
from fmu_src.structure import Structure

from .slaves import STEP, drive_track, drive_vehicle, open_small, small_track


@pytest.mark.parametrize(
    ("name", "value", "sentence"),
    [
        ("wheel[1].position", 8.0, "position 8.0 m lies outside the track of 0 to 7.8 m"),
        ("wheel[1].contact_force", float("nan"), "contact force nan N of wheel 1"),
    ],
)
def test_an_impossible_step_is_discarded_and_leaves_the_state(
    open_fmu, small_fmus, name, value, sentence
):
    slave = small_track(open_fmu, small_fmus)
    drive_track(slave, 0, 5)
    before, state = slave.outputs(), slave.fmu.getFMUstate()
    slave.set(name, value)
    with pytest.raises(FMICallException, match="discard"):
        slave.fmu.doStep(5 * STEP, STEP)
    assert sentence in slave.messages[-1]
    assert slave.last_successful_time() == 5 * STEP
    assert slave.outputs() == before
    slave.fmu.setFMUstate(state)
    slave.fmu.freeFMUstate(state)
    drive_track(slave, 5, 10)  # and it goes on
    undisturbed = small_track(open_fmu, small_fmus)
    drive_track(undisturbed, 0, 10)
    assert slave.outputs() == undisturbed.outputs()


def test_a_step_from_another_time_is_discarded(open_fmu, small_fmus):
    slave = small_track(open_fmu, small_fmus)
    drive_track(slave, 0, 2)
    with pytest.raises(FMICallException, match="discard"):
        slave.fmu.doStep(5 * STEP, STEP)
    assert "does not continue from" in slave.messages[-1]


def test_a_step_that_does_not_move_the_time_on_is_discarded(open_fmu, small_fmus):
    """Of a track, too, which knows no time."""
    slave = small_track(open_fmu, small_fmus)
    drive_track(slave, 0, 2)
    before = slave.outputs()
    with pytest.raises(FMICallException, match="discard"):
        slave.fmu.doStep(2 * STEP, 1e-22)
    assert "does not move the time on" in slave.messages[-1]
    assert slave.outputs() == before


@pytest.mark.parametrize(
    ("kind", "name", "value", "sentence"),
    [
        ("track", "pad_stiffness", -1.0, "pad_stiffness = -1.0 must be greater than 0"),
        ("track", "ballast", "soft", "ballast is 'soft'; it must be"),
        ("track", "mode_pairs", 100000, "mode_pairs = 100000 must lie between 1 and"),
        ("vehicle", "flat.depth", -1e-3, "depth"),
        ("vehicle", "flat.shape", "square", "square"),
        ("vehicle", "flat.shape", "missing.csv", "missing.csv: cannot be read"),
        ("vehicle", "speed", 0.0, "speed"),
    ],
)
def test_wrong_parameters_end_the_initialisation_with_a_sentence(
    open_fmu, small_fmus, kind, name, value, sentence
):
    path = small_fmus.track if kind == "track" else small_fmus.vehicle
    slave = open_fmu(path, initialise=False, **{name: value})
    with pytest.raises(FMICallException):
        slave.initialise()
    assert any(sentence in message for message in slave.messages), slave.messages


def test_a_state_brings_the_model_of_its_own_parameters(open_fmu, small_fmus):
    """Going back to before the initialisation and on with another instance's state."""
    first, second = (
        small_track(open_fmu, small_fmus, initialise=False, pad_stiffness=stiffness)
        for stiffness in (80e6, 40e6)
    )
    before = first.fmu.getFMUstate()
    first.initialise()
    second.initialise()
    first.fmu.setFMUstate(before)
    first.set("pad_stiffness", 40e6)
    state = second.fmu.getFMUstate()
    data = second.fmu.serializeFMUstate(state)
    first.fmu.setFMUstate(first.fmu.deSerializeFMUstate(data))
    drive_track(first, 0, 10)
    drive_track(second, 0, 10)
    assert first.outputs() == second.outputs()


@pytest.mark.parametrize("calls", [["enter", "enter"], ["exit"], ["enter", "exit", "exit"]])
def test_wrong_orders_of_the_initialisation_are_refused(open_fmu, small_fmus, calls):
    slave = open_fmu(small_fmus.vehicle, initialise=False)
    functions = {
        "enter": slave.fmu.enterInitializationMode,
        "exit": slave.fmu.exitInitializationMode,
    }
    for name in calls[:-1]:
        functions[name]()
    with pytest.raises(FMICallException, match="fatal"):
        functions[calls[-1]]()
    assert "initialisation" in slave.messages[0]


def test_a_step_before_the_initialisation_is_discarded(open_fmu, small_fmus):
    slave = open_fmu(small_fmus.vehicle, initialise=False)
    with pytest.raises(FMICallException, match="discard"):
        slave.fmu.doStep(0.0, STEP)
    assert "after the initialisation" in slave.messages[-1]


def test_fatal_answers_do_not_end_the_process(open_fmu, small_fmus):
    """pythonfmu alone crashes at about the fifth exception, or when the instance is freed."""
    slave = open_small("vehicle", open_fmu, small_fmus)
    for _ in range(20):
        with pytest.raises(FMICallException, match="fatal"):
            slave.fmu.getReal([99_999])
        with pytest.raises(FMICallException, match="fatal"):
            slave.set("wheel_mass", 600.0)
    assert any("wheel_mass is fixed" in message for message in slave.messages)
    drive_vehicle(slave, 0, 2)
    assert slave.get("wheel[1].contact_force") > 0.0


def test_two_builds_live_in_one_process(open_fmu, small_fmus, tmp_path):
    """A changed source goes under another package name; both keep their own code."""
    structure = Structure(bays=12, elements_per_bay=4, wheels=1, gauges=1).of("vehicle")
    contents = fmu_contents("vehicle", structure)
    package = next(
        name.split("/")[1] for name in contents if name.endswith("vehicle_fmu/contact.py")
    )
    changed = {
        name.replace(package, package + "x"): data.replace(
            package.encode(), package.encode() + b"x"
        )
        if name.endswith((".py", ".txt"))
        else data
        for name, data in contents.items()
    }
    contact = f"resources/{package}x/vehicle_fmu/rolling_wheels.py"
    changed[contact] = changed[contact].replace(
        b"\n    @property\n    def position",
        (
            b"\n    @property\n    def position(self):\n        import numpy as np\n"
            b"        return np.full(1, 42.0)\n\n    @property\n    def _position"
        ),
    )
    write_archive(tmp_path / "Other.fmu", changed)
    first = open_fmu(small_fmus.vehicle)
    second = open_fmu(tmp_path / "Other.fmu")
    assert first.get("wheel[1].position") == 12.7
    assert second.get("wheel[1].position") == 42.0


def test_code_of_another_build_under_the_same_name_is_refused(open_fmu, small_fmus, tmp_path):
    structure = Structure(bays=12, elements_per_bay=4, wheels=1, gauges=1).of("vehicle")
    contents = fmu_contents("vehicle", structure)
    slave = next(name for name in contents if name.endswith("_slave.py") and name.count("/") == 1)
    build = contents[slave].split(b'build = "')[1].split(b'"')[0]
    module = slave.removeprefix("resources/").removesuffix(".py")
    contents[f"resources/{module}_b.py"] = contents.pop(slave).replace(build, b"f" * len(build))
    contents["resources/slavemodule.txt"] = f"{module}_b".encode()
    write_archive(tmp_path / "Forged.fmu", contents)
    open_fmu(small_fmus.vehicle)
    with pytest.raises(Exception, match="instantiate"):
        open_fmu(tmp_path / "Forged.fmu")
