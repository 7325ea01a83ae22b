import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from vehicle_fmu.irregularity import RailIrregularity
from vehicle_fmu.parameters import FlatParameters, VehicleParameters
from vehicle_fmu.speed import ConstantSpeed, SpeedTable
from vehicle_fmu.vehicle_model import VehicleModel

OUTPUTS = ("position", "displacement", "velocity", "gap", "contact_force", "in_contact")
H = 1e-4


def build():
    """A vehicle with everything on: table speed, rolled periodic flat, irregular rail."""
    rng = np.random.default_rng(3)
    vehicle = VehicleModel(
        VehicleParameters(offsets=(0.0, 1.8, 3.6)),
        flat=FlatParameters(position=12.72, periodic=True, rolled=True, wheel=1),
        speed=SpeedTable(time=np.array([0.0, 0.05]), speed=np.array([11.0, 14.0])),
        irregularity=RailIrregularity(
            position=np.linspace(8.0, 14.0, 61), drop=rng.normal(0.0, 1e-5, 61)
        ),
    )
    vehicle.initialise(0.0)
    return vehicle


def everything(vehicle):
    return vehicle.state.tobytes(), *(getattr(vehicle, name).tobytes() for name in OUTPUTS)


def rail(k, scale=1.0):
    return scale * 1e-4 * np.array([np.sin(0.1 * k), np.cos(0.07 * k), 0.01 * k])


def test_restored_state_repeats_every_bit():
    vehicle = build()
    for k in range(40):
        vehicle.step(k * H, H, rail(k), linear=True)
    saved, seen = vehicle.state, everything(vehicle)

    def onwards():
        trail = []
        for k in range(40, 80):
            vehicle.step(k * H, H, rail(k), linear=bool(k % 3))
            trail.append(everything(vehicle))
        return trail

    first = onwards()
    vehicle.state = saved
    assert everything(vehicle) == seen
    assert onwards() == first


def test_state_restores_a_vehicle_that_never_ran():
    one, other = build(), build()
    for k in range(30):
        one.step(k * H, H, rail(k), linear=True)
    other.state = one.state
    assert everything(other) == everything(one)
    for vehicle in (one, other):
        vehicle.step(30 * H, H, rail(30), linear=True)
    assert everything(other) == everything(one)


def test_state_contains_start_time_and_is_a_copy():
    vehicle = build()
    vehicle.initialise(0.02)
    vehicle.step(0.02, H, rail(1), linear=True)
    saved = vehicle.state
    seen = everything(vehicle)
    vehicle.state[:] = 0.0
    vehicle.displacement[:] = 0.0
    assert everything(vehicle) == seen
    vehicle.initialise(0.0)
    vehicle.state = saved
    assert everything(vehicle) == seen


@settings(deadline=None, max_examples=20)
@given(st.lists(st.tuples(st.sampled_from([H, H / 2, 0.3 * H]), st.floats(-2, 2)), max_size=6))
def test_iterating_and_rejecting_steps_leaves_no_trace(attempts):
    straight, iterated = build(), build()
    for k in range(12):
        saved = iterated.state
        for step, scale in attempts:
            iterated.step(k * H, step, rail(k, scale), linear=True)
            iterated.state = saved
        for vehicle in (straight, iterated):
            vehicle.step(k * H, H, rail(k), linear=True)
        assert everything(iterated) == everything(straight)


def test_interleaved_vehicles_do_not_disturb_each_other():
    alone = build()
    trail = []
    for k in range(30):
        alone.step(k * H, H, rail(k), linear=True)
        trail.append(everything(alone))
    one, other = build(), build()
    for k in range(30):
        one.step(k * H, H, rail(k), linear=True)
        other.step(k * H, H, rail(k, -3.0), linear=False)
        assert everything(one) == trail[k]
    assert everything(other) != everything(one)


def test_initialising_again_forgets_the_run():
    fresh, used = build(), build()
    for k in range(30):
        used.step(k * H, H, rail(k), linear=True)
    for vehicle in (fresh, used):
        vehicle.initialise(0.0, rail(5))
    assert everything(used) == everything(fresh)


def test_same_step_after_another_start_is_another_step():
    fresh, used = build(), build()
    used.step(0.0, H, rail(0), linear=True)
    used.step(H, H, rail(1), linear=True)
    for vehicle in (fresh, used):
        vehicle.initialise(H)
        vehicle.step(H, H, rail(1), linear=True)
    assert everything(used) == everything(fresh)


@pytest.mark.parametrize(
    "bad",
    [
        {"rail_displacement": np.array([0.0, np.nan, 0.0])},
        {"rail_displacement": np.array([0.0, 0.0, np.inf])},
        {"rail_displacement": np.array([-1e300, 0.0, 0.0])},
        {"rail_displacement": np.zeros(2)},
        {"time": 1.0},
        {"time": np.nan},
        {"step_size": 0.0},
        {"step_size": -H},
        {"step_size": np.nan},
    ],
)
def test_refused_step_leaves_the_vehicle_as_it_was(bad):
    vehicle, undisturbed = build(), build()
    for v in (vehicle, undisturbed):
        v.step(0.0, H, rail(0), linear=True)
    with pytest.raises(ValueError, match=r"rail displacement|step"):
        vehicle.step(
            **{"time": H, "step_size": H, "rail_displacement": rail(1), **bad}, linear=True
        )
    assert everything(vehicle) == everything(undisturbed)
    for v in (vehicle, undisturbed):
        v.step(H, H, rail(1), linear=True)
    assert everything(vehicle) == everything(undisturbed)


@pytest.mark.parametrize(
    ("state", "sentence"),
    [
        (np.zeros(10), r"the state has shape \(10,\); that of 3 wheels has \(11,\)"),
        (np.full(11, np.nan), "the state holds a NaN or infinity"),
    ],
)
def test_foreign_state_is_refused(state, sentence):
    vehicle = build()
    seen = everything(vehicle)
    with pytest.raises(ValueError, match=sentence):
        vehicle.state = state
    assert everything(vehicle) == seen


def test_constructing_builds_no_profile():
    vehicle = VehicleModel(
        VehicleParameters(), flat=FlatParameters(rolled=True), speed=ConstantSpeed(speed=10.0)
    )
    assert "_profiles" not in vars(vehicle._excitation)
    vehicle.initialise(0.0)
    assert "_profiles" in vars(vehicle._excitation)
