"""The slaves as a master sees them: equal to their models, restorable, honest about failures."""

import subprocess
import sys

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from build_fmus import Structure
from fmu_src.archive import write_archive
from fmu_src.python.packaging import fmu_contents
from track_fmu.assembly import assemble
from track_fmu.ballast import PolynomialBallast
from track_fmu.modal import compute_basis
from track_fmu.parameters import TrackParameters
from track_fmu.reduction import reduce_track
from track_fmu.track_model import TrackModel, TrackOptions
from vehicle_fmu.parameters import FlatParameters, VehicleParameters
from vehicle_fmu.speed import ConstantSpeed
from vehicle_fmu.vehicle_model import VehicleModel

from .instance import Instance

STATIC_LOAD = 117_720.0
STEP = 1e-4
SMALL = {"mode_pairs": 40, "linear_inputs": True, "gauge[1].position": 3.9}
NEAR = {"wheel[1].position": 3.9, "wheel[1].contact_force": STATIC_LOAD}


def small_track(open_fmu, small_fmus, **values):
    return open_fmu(small_fmus.track, **(SMALL | NEAR | values))


def drive_track(track, first, last):
    """Steps with a force that depends on the step number alone."""
    for k in range(first, last):
        track.set("wheel[1].position", 3.9 + 1e-3 * (k + 1))
        track.set("wheel[1].contact_force", STATIC_LOAD * (1.0 + 0.3 * np.sin(0.1 * (k + 1))))
        track.fmu.doStep(k * STEP, STEP)


def drive_vehicle(vehicle, first, last):
    for k in range(first, last):
        vehicle.set("wheel[1].rail_displacement", 1e-3 * np.sin(0.02 * (k + 1)))
        vehicle.fmu.doStep(k * STEP, STEP)


DRIVES = {"track": drive_track, "vehicle": drive_vehicle}


def open_small(kind, open_fmu, small_fmus):
    if kind == "track":
        return small_track(open_fmu, small_fmus)
    return open_fmu(small_fmus.vehicle, **{"linear_inputs": True, "flat.position": 12.75})


def test_the_track_fmu_is_the_track_model(open_fmu, small_fmus):
    slave = small_track(open_fmu, small_fmus)
    parameters = TrackParameters(bays=12, elements_per_bay=4)
    matrices = assemble(parameters)
    reduced = reduce_track(parameters, matrices, compute_basis(matrices, mode_pairs=40))
    options = TrackOptions(wheels=1, gauges=(3.9,))
    model = TrackModel(reduced, options, ballast=PolynomialBallast())
    model.start(np.array([3.9]), np.array([STATIC_LOAD]))
    drive_track(slave, 0, 50)
    for k in range(50):
        force = STATIC_LOAD * (1.0 + 0.3 * np.sin(0.1 * (k + 1)))
        model.step(STEP, np.array([3.9 + 1e-3 * (k + 1)]), np.array([force]))
    seen = model.observe()
    for name, expected in (
        ("wheel[1].rail_displacement", model.rail_displacement[0]),
        ("wheel[1].rail_velocity", seen.rail_velocity[0]),
        ("wheel[1].bending_moment", seen.wheel_moment[0]),
        ("gauge[1].bending_moment", seen.gauge_moment[0]),
        ("sleeper[6].displacement", seen.sleeper_displacement[5]),
        ("pad[6].force", seen.pad_force[5]),
        ("ballast[6].force", seen.ballast_force[5]),
    ):
        # the cached basis and the one computed here may differ in the last digits
        assert slave.get(name) == pytest.approx(expected, rel=1e-9), name


def test_the_vehicle_fmu_is_the_vehicle_model(open_fmu, small_fmus):
    slave = open_small("vehicle", open_fmu, small_fmus)
    model = VehicleModel(
        VehicleParameters(wheels=1),
        flat=FlatParameters(shape="haversine", position=12.75),
        speed=ConstantSpeed(speed=40 / 3.6),
    )
    model.initialise(0.0, np.zeros(1))
    drive_vehicle(slave, 0, 100)
    for k in range(100):
        rail = np.array([1e-3 * np.sin(0.02 * (k + 1))])
        model.step(k * STEP, STEP, rail, linear=True)
    for quantity in ("position", "contact_force", "displacement", "velocity", "gap"):
        assert slave.get(f"wheel[1].{quantity}") == getattr(model, quantity)[0]
    assert slave.get("wheel[1].in_contact") == bool(model.in_contact[0])


def test_outputs_follow_the_inputs_during_initialisation(open_fmu, small_fmus):
    slave = small_track(open_fmu, small_fmus, initialise=False)
    slave.fmu.enterInitializationMode()
    under_load = slave.get("wheel[1].rail_displacement")
    slave.set("wheel[1].contact_force", 0.0)
    assert slave.get("wheel[1].rail_displacement") == 0.0
    slave.set("wheel[1].contact_force", STATIC_LOAD)
    assert slave.get("wheel[1].rail_displacement") == under_load > 1e-3
    slave.fmu.exitInitializationMode()


def test_parameters_may_be_set_until_the_initialisation_ends(open_fmu, small_fmus):
    """Hosts such as libcosim set them in initialisation mode, as the standard allows."""
    before = small_track(open_fmu, small_fmus, pad_stiffness=40e6)
    during = small_track(open_fmu, small_fmus, initialise=False)
    during.fmu.enterInitializationMode()
    stiff = during.get("wheel[1].rail_displacement")
    during.set("pad_stiffness", 40e6)
    assert during.get("wheel[1].rail_displacement") > stiff
    during.fmu.exitInitializationMode()
    for slave in (before, during):
        drive_track(slave, 0, 3)
    assert during.outputs() == before.outputs()


@pytest.mark.parametrize("kind", DRIVES)
def test_rollback_is_bitwise(kind, open_fmu, small_fmus):
    slave, drive = open_small(kind, open_fmu, small_fmus), DRIVES[kind]
    drive(slave, 0, 10)
    saved = slave.fmu.getFMUstate()
    drive(slave, 10, 30)
    first = slave.outputs()
    slave.fmu.setFMUstate(saved)
    slave.fmu.doStep(10 * STEP, 7 * STEP)  # a detour
    slave.fmu.setFMUstate(saved)
    drive(slave, 10, 30)
    assert slave.outputs() == first
    slave.fmu.freeFMUstate(saved)


@pytest.mark.parametrize("kind", DRIVES)
def test_a_serialised_state_goes_on_in_an_instance_that_was_never_initialised(
    kind, open_fmu, small_fmus
):
    slave, drive = open_small(kind, open_fmu, small_fmus), DRIVES[kind]
    drive(slave, 0, 10)
    state = slave.fmu.getFMUstate()
    data = slave.fmu.serializeFMUstate(state)
    slave.fmu.freeFMUstate(state)
    drive(slave, 10, 20)
    path = small_fmus.track if kind == "track" else small_fmus.vehicle
    other = open_fmu(path, initialise=False)
    copy = other.fmu.deSerializeFMUstate(data)
    other.fmu.setFMUstate(copy)
    other.fmu.freeFMUstate(copy)
    drive(other, 10, 20)
    assert other.outputs() == slave.outputs()


CONTINUE = """
import sys
sys.path.insert(0, {root!r})
from tests.fmus.instance import Instance
from tests.fmus.test_slaves import drive_track
slave = Instance({path!r}, initialise=False)
state = slave.fmu.deSerializeFMUstate(open({data!r}, "rb").read())
slave.fmu.setFMUstate(state)
drive_track(slave, 10, 20)
print([value.hex() for value in slave.outputs()])
slave.close()
"""


def test_a_serialised_state_goes_on_in_another_process(open_fmu, small_fmus, tmp_path, request):
    slave = small_track(open_fmu, small_fmus)
    drive_track(slave, 0, 10)
    state = slave.fmu.getFMUstate()
    (tmp_path / "state").write_bytes(slave.fmu.serializeFMUstate(state))
    slave.fmu.freeFMUstate(state)
    drive_track(slave, 10, 20)
    script = CONTINUE.format(
        root=str(request.config.rootpath),
        path=str(small_fmus.track),
        data=str(tmp_path / "state"),
    )
    answer = subprocess.run(
        [sys.executable, "-c", script], check=True, capture_output=True, text=True
    )
    assert answer.stdout.strip() == str([value.hex() for value in slave.outputs()])


def test_damaged_states_are_refused(open_fmu, small_fmus):
    slave = small_track(open_fmu, small_fmus)
    state = slave.fmu.getFMUstate()
    data = bytearray(slave.fmu.serializeFMUstate(state))
    slave.fmu.freeFMUstate(state)
    data[len(data) // 2] ^= 1
    slave.dead = True
    with pytest.raises(FMICallException):
        slave.fmu.deSerializeFMUstate(bytes(data))
    assert "truncated or altered" in slave.messages[-1]


def test_two_instances_do_not_meet(open_fmu, small_fmus):
    together = [small_track(open_fmu, small_fmus, name=name) for name in ("one", "two")]
    alone = small_track(open_fmu, small_fmus)
    for k in range(20):
        drive_track(together[0], k, k + 1)
        together[1].set("wheel[1].contact_force", 2 * STATIC_LOAD)
        together[1].fmu.doStep(k * STEP, STEP)
    drive_track(alone, 0, 20)
    assert together[0].outputs() == alone.outputs()
    assert together[1].outputs() != alone.outputs()


def test_many_instances_live_and_die_in_one_process(small_fmus):
    """pythonfmu alone fails at the second instance."""
    for _ in range(20):
        slave = Instance(small_fmus.vehicle, linear_inputs=True)
        drive_vehicle(slave, 0, 2)
        assert slave.get("wheel[1].position") == pytest.approx(12.7 + 2 * STEP * 40 / 3.6)
        slave.close()


def test_reset_starts_again(open_fmu, small_fmus):
    slave = small_track(open_fmu, small_fmus)
    drive_track(slave, 0, 10)
    first = slave.outputs()
    slave.fmu.reset()
    slave.fmu.setupExperiment(startTime=0.0)
    for name, value in (SMALL | NEAR).items():
        slave.set(name, value)
    slave.initialise()
    drive_track(slave, 0, 10)
    assert slave.outputs() == first


# failures


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
    contact = f"resources/{package}x/vehicle_fmu/vehicle_model.py"
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
