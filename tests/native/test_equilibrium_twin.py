"""The native vehicles start in the equilibrium of the numpy ones, in every vehicle there is."""

import math

import numpy as np
import pytest

from fmu_src.native.model_resources import masses_resource, vehicle_resource
from railcosim.motion import speed_law
from railcosim.presets import PRESETS
from railcosim.scenario_file import read_scenario
from railcosim.start_values import vehicle_values
from vehicle_fmu.standing import Standing

from .library import NativeError
from .twins import assert_alike

LOAD = 80e3
OFFSETS = {
    (3, 1): (1.7, 3.4),
    (6, 2): (1.7, 3.4, 12.0, 13.7, 15.4),
    (6, 3): (2.0, 8.0, 10.0, 16.0, 18.0),
    (3, 3): (6.0, 13.0),
    (1, 1): (),
}
STOPS = {
    "primary.clearance": 1e-3,
    "primary.stop_stiffness": 4e6,
    "secondary.clearance": -2e-4,
    "secondary.stop_stiffness": 1e6,
}
TREAD = {"tread.mass": 250.0, "tread.stiffness": 9e8, "tread.damping": 2e3}


def values_of(size, options):
    offsets = {f"wheel[{i}].offset": offset for i, offset in enumerate(OFFSETS[size], start=2)}
    return {"model": "suspended", "static_wheel_load": LOAD, **offsets, **options}


@pytest.fixture
def waves(tmp_path):
    x = np.arange(-30.0, 60.0, 0.1)
    path = tmp_path / "rail.csv"
    rows = (f"{a!r},{5e-3 * math.sin(a) + 0.002 * a!r}\n" for a in x.tolist())
    path.write_text("position,drop\n" + "".join(rows), encoding="ascii")
    return {"rail_irregularity": str(path)}


@pytest.mark.parametrize("options", [{}, STOPS, STOPS | TREAD], ids=["linear", "stops", "tread"])
@pytest.mark.parametrize("size", list(OFFSETS))
def test_start_on_wheels_of_any_height(vehicle_pair, waves, size, options):
    wheels, bogies = size
    pair = vehicle_pair(
        vehicle_resource(wheels=wheels, bogies=bogies), wheels=wheels, bogies=bogies,
        values=values_of(size, options) | waves,
    )  # fmt: skip
    rail = 1e-2 * np.random.default_rng(wheels).normal(size=wheels)
    if wheels > 1:
        rail[1] += 0.3  # a wheel of three hangs
    pair.start(0.25, rail)
    assert_alike(pair.outputs())
    if wheels == 3 * bogies:
        assert pair.native.group("wheel[#].contact_force")[1] == 0.0
    for _ in range(5):
        pair.step(1e-4, rail)
    assert_alike(pair.outputs(), parts=5)


@pytest.mark.parametrize("options", [{}, STOPS, STOPS | TREAD], ids=["linear", "stops", "tread"])
@pytest.mark.parametrize("size", list(OFFSETS))
def test_start_where_a_track_says_that_the_wheels_are(masses_pair, size, options):
    wheels, bogies = size
    pair = masses_pair(
        masses_resource(wheels=wheels, bogies=bogies), wheels=wheels, bogies=bogies,
        values=values_of(size, options),
    )  # fmt: skip
    random = np.random.default_rng(wheels)
    standing = Standing(
        displacement=1e-2 * random.normal(size=wheels), velocity=random.normal(size=wheels),
        mean_velocity=0.1 * random.normal(size=wheels),
    )  # fmt: skip
    pair.start(0.25, np.full(wheels, LOAD), standing)
    assert_alike(pair.outputs())
    changes = pair.native.group("wheel[#].load_change")
    assert changes.any() == (size in {(3, 1), (6, 2), (6, 3), (3, 3)})
    for linear in (True, False, False):
        pair.step(1e-4, np.full(wheels, LOAD), linear=linear)
    assert_alike(pair.outputs(), parts=3)


@pytest.mark.parametrize("name", sorted(PRESETS))
def test_vehicles_of_the_literature(vehicle_pair, masses_pair, waves, name):
    scenario = read_scenario(None, (f"vehicle.preset={name}", "track.bays=80"))
    law = speed_law(scenario.vehicle)
    size = {"wheels": 4, "bogies": 2}
    own = vehicle_values(scenario, law) | waves
    vehicle = vehicle_pair(vehicle_resource(**size), **size, values=own)
    vehicle.start(0.0, np.array([1.0, 1.1, 0.9, 1.3]) * 1e-3)
    load = own["static_wheel_load"]
    assert vehicle.native.group("wheel[#].contact_force") == pytest.approx([load] * 4, rel=1e-12)
    on_track = vehicle_values(scenario, law, "track")
    masses = masses_pair(masses_resource(**size), **size, values=on_track)
    masses.start(0.0, np.full(4, load))
    random = np.random.default_rng(5)
    for _ in range(100):
        vehicle.step(2e-4, 1e-3 + 1e-4 * random.normal(size=4))
        masses.step(2e-4, load * random.uniform(0.5, 1.5, 4), linear=True)
    assert_alike(vehicle.outputs(), parts=100)
    assert_alike(masses.outputs(), parts=100)


def test_what_has_no_equilibrium_in_numbers_is_refused(native):
    vehicle = native("vehicle", vehicle_resource(wheels=3, bogies=1))
    for name, value in values_of((3, 1), {}).items():
        vehicle.set_one(name, value)
    vehicle.enter()
    vehicle.set_group("wheel[#].rail_displacement", [0.0, 1e300, 0.0])
    with pytest.raises(NativeError, match="finds no static equilibrium on wheels displaced by"):
        vehicle.exit()
