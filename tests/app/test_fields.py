import math

import pytest

from railcosim.errors import InputError
from railcosim.sections import Flat, Run
from railcosim.track_section import Track
from railcosim.vehicle_section import Vehicle


@pytest.mark.parametrize(
    ("section", "values", "parts"),
    [
        (Vehicle, {"speed_kmh": 0.0}, ["vehicle.speed_kmh is 0 km/h", "at least 0.1 km/h"]),
        (Vehicle, {"speed_kmh": -3}, ["-3 km/h", "at least 0.1 km/h"]),
        (Vehicle, {"speed_kmh": math.nan}, ["nan", "finite"]),
        (Vehicle, {"speed_kmh": math.inf}, ["inf", "finite"]),
        (Vehicle, {"speed_kmh": "fast"}, ["'fast'", "a number in km/h"]),
        (Vehicle, {"axle_load_t": 24e3}, ["24000 t", "at most 100 t", "default 24 t"]),
        (Vehicle, {"speed_table": "speed.txt"}, ["'speed.txt'", "a .csv file"]),
        (Vehicle, {"axle_load_t": True}, ["True", "a number in t", "default 24 t"]),
        (Vehicle, {"speed_kmh": 10**400}, ["000", "a number in km/h"]),
        (Track, {"bays": 10**400}, ["000", "a whole number"]),
        (Track, {"bays": 10**9}, ["1e+09 bays", "at most 10000 bays"]),
        (Flat, {"depth": -1e-3}, ["flat.depth is -0.001 m", "at least 0 m", "default 0.0009 m"]),
        (Flat, {"shape": "square"}, ["'square'", "haversine, parabola, cusp, chord, none"]),
        (Flat, {"shape": 3}, ["3", "haversine, parabola"]),
        (Flat, {"periodic": 1}, ["1", "true or false", "default false"]),
        (Flat, {"wheel": 0}, ["flat.wheel is 0", "at least 1"]),
        (Track, {"bays": 2.5}, ["2.5 bays", "a whole number", "default 50 bays"]),
        (Track, {"bays": 1}, ["1 bays", "at least 2 bays"]),
        (Track, {"ballast": "linar"}, ["'linar'", "state_dependent, linear"]),
        (Track, {"pad_stiffness": 0.0}, ["0 N/m", "above 0 N/m", "default 8e+07 N/m"]),
        (Run, {"approach": 0.0}, ["run.approach is 0 m", "above 0 m", "default 3.9 m"]),
        (Run, {"approach": None}, ["None", "a number in m"]),
    ],
)
def test_a_wrong_value_is_named_with_its_limit_and_the_default(section, values, parts):
    with pytest.raises(InputError) as caught:
        section(**values)
    message = str(caught.value)
    assert "\n" not in message
    for part in parts:
        assert part in message


def test_whole_numbers_are_accepted_as_numbers():
    speed = Vehicle(speed_kmh=35).speed_kmh
    assert (speed, type(speed)) == (35.0, float)


def test_optional_keys_may_be_left_out():
    assert Vehicle(speed_kmh=None).constant_speed == Vehicle(speed_kmh=40).constant_speed


def test_a_measured_flat_is_a_csv_file():
    assert Flat(shape="tread.CSV").is_measured
    assert not Flat(shape="cusp").is_measured
