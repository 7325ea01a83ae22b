import math

import numpy as np
import pytest

from vehicle_fmu.irregularity import RailIrregularity
from vehicle_fmu.parameters import FlatParameters, VehicleParameters
from vehicle_fmu.speed import ConstantSpeed, SpeedTable
from vehicle_fmu.vehicle_model import VehicleModel
from vehicle_fmu.wheel_profile import WheelProfileTable

DISTANCE = np.array([-0.05, -0.01, 0.01, 0.05])
DROP = np.array([0.0, 9e-4, 9e-4, 0.0])


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [
        ({"offsets": ()}, "of wheel 1, must be 0"),
        ({"wheel_mass": -1.0}, "wheel_mass is -1 kg; .*half the unsprung mass"),
        ({"static_wheel_load": 0.0}, "static_wheel_load is 0 N"),
        ({"offsets": (0.0, math.inf)}, "offset of wheel 2 is inf m"),
        ({"wheel_radius": math.nan}, "wheel_radius is nan m"),
        ({"hertz_coefficient": 0.0}, r"hertz_coefficient is 0 N/m\^1.5"),
        ({"substep": 0.0}, "substep is 0 s"),
        ({"initial_position": math.nan}, "initial_position is nan m"),
    ],
)
def test_impossible_vehicle_is_refused(wrong, sentence):
    with pytest.raises(ValueError, match=sentence):
        VehicleParameters(**wrong)


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [
        ({"shape": "square"}, "flat shape is 'square'; it must be one of none, haversine"),
        ({"length": 0.0}, "flat length is 0 m"),
        ({"depth": -9e-4}, "flat depth is -0.0009 m; .*must not be negative"),
        ({"depth": math.nan}, "flat depth is nan m"),
        ({"wheel": 0}, "flat wheel is 0; wheels are counted from 1"),
        ({"position": math.inf}, "flat position is inf m"),
    ],
)
def test_impossible_flat_is_refused(wrong, sentence):
    with pytest.raises(ValueError, match=sentence):
        FlatParameters(**wrong)


def build(*, flat_table=None, **flat):
    return VehicleModel(
        VehicleParameters(),
        flat=FlatParameters(**flat),
        flat_table=flat_table,
        speed=ConstantSpeed(speed=10.0),
    )


@pytest.mark.parametrize(
    ("flat", "sentence"),
    [
        ({"wheel": 3}, "the flat is on wheel 3, the vehicle has 2"),
        ({"length": 100.0}, "acts over 100 m, the wheel's circumference is 2.82743 m"),
        ({"depth": 0.9}, "0.9 m deep, the wheel's radius 0.45 m"),
        ({"shape": "table"}, "shape is 'table' and no table is given"),
    ],
)
def test_flat_that_does_not_fit_is_refused(flat, sentence):
    with pytest.raises(ValueError, match=sentence):
        build(**flat)


def test_table_with_another_shape_is_refused():
    table = WheelProfileTable(distance=DISTANCE, drop=DROP)
    with pytest.raises(ValueError, match="shape is 'cusp' and a table is given"):
        build(shape="cusp", flat_table=table)


def test_raised_metal_must_have_room_to_roll():
    distance = np.array([-1.41, 0.0, 0.5, 1.0, 1.41])
    table = WheelProfileTable(distance=distance, drop=np.array([0.0, 1e-3, 0.0, -1e-3, 0.0]))
    build(shape="table", flat_table=table)
    # sqrt(2 * 0.45 m * 1 mm) = 30 mm on both sides.
    with pytest.raises(ValueError, match=r"acts over 2\.88 m, the wheel's circumference is 2\.827"):
        build(shape="table", flat_table=table, rolled=True)


def test_round_vehicle_ignores_the_numbers_of_its_flat():
    model = build(shape="none", length=100.0, depth=3.0, wheel=7)
    model.initialise(0.0)
    assert model.contact_force == pytest.approx(model.parameters.static_wheel_load, rel=1e-12)


@pytest.mark.parametrize(
    ("distance", "drop", "sentence"),
    [
        (DISTANCE, [0.0, math.nan, 9e-4, 0.0], "drop .* is nan at point 2 of 4"),
        ([-0.05, math.inf, 0.01, 0.05], DROP, "distance .* is inf at point 2 of 4"),
        (DISTANCE[::-1], DROP, "goes from 0.05 to 0.01 at point 2; it must increase"),
        (DISTANCE[:3], DROP[1:], "3 points; at least 4 are needed"),
        (DISTANCE, DROP[:3], "4 values of distance .* but 3 of drop"),
        (DISTANCE[:, None], DROP, "distance .* has 2 dimensions"),
        (DISTANCE, DROP + 1e-6, "drop is 1e-06 m at its end -0.05 m; it must be zero there"),
        (DISTANCE, DROP - [0, 0, 0, 1e-6], "drop is -1e-06 m at its end 0.05 m"),
        (DISTANCE, -DROP, "change the sign"),
    ],
)
def test_wheel_profile_that_is_none_is_refused(distance, drop, sentence):
    with pytest.raises(ValueError, match=f"wheel profile: .*{sentence}"):
        WheelProfileTable(distance=distance, drop=drop)


def test_irregularity_that_is_none_is_refused():
    with pytest.raises(ValueError, match=r"rail irregularity: drop \[m\] is nan at point 4 of 4"):
        RailIrregularity(position=np.arange(4.0), drop=[0.0, 0.0, 0.0, math.nan])


@pytest.mark.parametrize("speed", [0.0, -3.0, math.nan, math.inf])
def test_constant_speed_must_be_forwards(speed):
    with pytest.raises(ValueError, match=f"speed is {speed:g} m/s; .*must move forwards"):
        ConstantSpeed(speed=speed)


@pytest.mark.parametrize(
    ("time", "speed", "sentence"),
    [
        ([0.0, 1.0, 2.0], [10.0, 0.0, 10.0], "the speed is 0 m/s at 1 s"),
        ([0.0, 0.0], [10.0, 10.0], "goes from 0 to 0 at point 2"),
        ([0.0], [10.0], "1 points; at least 2 are needed"),
    ],
)
def test_speed_table_must_go_forwards(time, speed, sentence):
    with pytest.raises(ValueError, match=f"speed table: .*{sentence}"):
        SpeedTable(time=time, speed=speed)


def test_tables_are_read_only_copies():
    drop = DROP.copy()
    table = WheelProfileTable(distance=DISTANCE, drop=drop)
    drop[1] = 1.0
    assert table.drop[1] == DROP[1]
    with pytest.raises(ValueError, match="read-only"):
        table.drop[1] = 1.0


@pytest.mark.parametrize(
    ("rail", "sentence"),
    [
        (np.array([0.0, np.nan]), "rail displacement under wheel 2 is nan m"),
        (np.array([-np.inf, 0.0]), "rail displacement under wheel 1 is -inf m"),
        (np.array([-1e300, 0.0]), "rail displacement of -1e.300 m under wheel 1 drives the wheel"),
        (np.zeros(3), r"shape \(3,\); 2 wheels need \(2,\)"),
    ],
)
def test_impossible_input_is_refused_by_name(rail, sentence):
    vehicle = build()
    vehicle.initialise(0.0)
    with pytest.raises(ValueError, match=sentence):
        vehicle.step(0.0, 1e-4, rail, linear=True)


def test_start_must_be_finite():
    with pytest.raises(ValueError, match="the start time is nan s"):
        build().initialise(math.nan)
    with pytest.raises(ValueError, match="rail displacement under wheel 1 is nan m"):
        build().initialise(0.0, np.array([math.nan, 0.0]))


def test_steps_must_join():
    vehicle = build()
    vehicle.initialise(0.0)
    with pytest.raises(ValueError, match=r"the step starts at 0.5 s, the vehicle is at 0.0 s"):
        vehicle.step(0.5, 1e-4, np.zeros(2), linear=True)


def test_steps_must_move_the_time_on():
    vehicle = build()
    vehicle.initialise(1000.0)
    with pytest.raises(ValueError, match=r"1e-14 s from 1000.0 s does not move the time on"):
        vehicle.step(1000.0, 1e-14, np.zeros(2), linear=True)
