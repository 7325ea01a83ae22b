"""The slaves as a master sees them: equal to their models, and restorable."""

import subprocess
import sys

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

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
from .slaves import (
    DRIVES,
    NEAR,
    SMALL,
    STATIC_LOAD,
    STEP,
    drive_track,
    drive_vehicle,
    open_small,
    small_track,
)


def test_the_track_fmu_is_the_track_model(open_fmu, small_fmus):
    slave = small_track(open_fmu, small_fmus)
    parameters = TrackParameters(bays=12, elements_per_bay=4)
    matrices = assemble(parameters)
    reduced = reduce_track(parameters, matrices, compute_basis(matrices, mode_pairs=40))
    options = TrackOptions(wheels=1, gauges=(3.9,), initial_speed=40.0 / 3.6)
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
        VehicleParameters(offsets=(0.0,)),
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
from tests.fmus.slaves import drive_track
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
