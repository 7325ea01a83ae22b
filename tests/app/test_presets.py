"""Vehicles of the literature and suspended vehicles in a scenario."""

from pathlib import Path

import pytest

from railcosim.dataset import count
from railcosim.errors import InputError
from railcosim.presets import PRESETS
from railcosim.scenario import Scenario
from railcosim.scenario_file import from_toml, read_scenario, to_toml
from railcosim.sections import Flat, Run
from railcosim.signals import SIGNALS, signals_of
from railcosim.start_values import vehicle_values
from railcosim.suspension_section import Suspension
from railcosim.track_section import Track
from railcosim.vehicle_section import GRAVITY, Vehicle
from vehicle_fmu.speed import ConstantSpeed

LONG = ("track.bays=80", "flat.position=40")


@pytest.mark.parametrize("name", sorted(PRESETS))
def test_the_axle_loads_of_a_preset_are_those_of_all_its_masses(name):
    """What they leave over wheels and bogies is half the car body that the source gives."""
    preset, scenario = PRESETS[name], read_scenario(None, (f"vehicle.preset={name}", *LONG))
    vehicle, suspension = scenario.vehicle, scenario.suspension
    carried = vehicle.wheels * vehicle.static_wheel_load / GRAVITY
    left = carried - vehicle.wheels * vehicle.wheel_mass - vehicle.bogies * suspension.bogie_mass
    assert left == pytest.approx(0.5 * preset.car_mass, rel=1e-12)
    assert vehicle.is_suspended
    assert vehicle.offsets[2] == preset.bogie_distance
    assert suspension.primary_stiffness == preset.primary[0]
    assert len(preset.source) > 40


def test_the_primary_springs_of_the_manchester_coach_are_those_of_its_benchmark():
    """1.22 MN/m per axle box; TTB-2D, where the rest of the figures came from, rounds it."""
    preset = PRESETS["manchester_coach"]
    assert preset.primary == (1.22e6, 4e3)
    assert Suspension().primary_stiffness == 1.22e6
    scenario = read_scenario(None, ("vehicle.preset=manchester_coach", *LONG))
    defaults = Suspension()
    for key in ("primary_damping", "secondary_stiffness", "secondary_damping", "bogie_mass"):
        assert getattr(scenario.suspension, key) == getattr(defaults, key)


def test_keys_of_the_file_are_above_those_of_the_preset():
    overrides = ("vehicle.preset=velaro_e_coach", "suspension.primary_damping=25e3")
    scenario = read_scenario(None, (*overrides, "vehicle.wheel_mass=800", *LONG))
    assert scenario.suspension.primary_damping == 25e3
    assert scenario.vehicle.wheel_mass == 800.0
    assert scenario.vehicle.axle_base == 2.5
    assert from_toml(to_toml(scenario)) == scenario.resolved()


def test_unknown_presets_are_refused():
    with pytest.raises(InputError, match=r"vehicle.preset is 'tgv' but must be one of manch"):
        read_scenario(None, ("vehicle.preset=tgv",))


def test_wheels_run_in_their_bogies():
    vehicle = Vehicle(wheels=6, bogies=2, axle_base=2.0, bogie_distance=9.0)
    assert vehicle.offsets == (0.0, 2.0, 4.0, 9.0, 11.0, 13.0)
    scenario = Scenario(vehicle=vehicle, flat=Flat(wheel=4, position=16.6), run=Run(approach=3.0))
    assert scenario.start_position == pytest.approx(16.6 - 3.0 + 9.0, abs=1e-12)
    law = ConstantSpeed(speed=10.0)
    for contact in ("vehicle", "track"):
        values = vehicle_values(scenario, law, contact)
        assert [values[f"wheel[{k}].offset"] for k in range(2, 7)] == [2.0, 4.0, 9.0, 11.0, 13.0]


@pytest.mark.parametrize(
    ("sections", "sentence"),
    [
        ({"vehicle": {"wheels": 3, "bogies": 2}}, "vehicle.wheels is 3, which 2 bogies cannot"),
        (
            {"vehicle": {"model": "suspended", "axle_load_t": 2.0}},
            "vehicle and suspension do not fit together: .* have 2492.5 kg over this rail",
        ),
        (
            {"vehicle": {"model": "suspended"}, "suspension": {"car_mass": 50e3}},
            "raise vehicle.axle_load_t or give smaller masses",
        ),
        (
            {"suspension": {"tread_mass": 600.0, "tread_stiffness": 1e9}},
            "suspension.tread_mass is 600 kg; it must be below vehicle.wheel_mass",
        ),
        ({"suspension": {"tread_mass": 300.0}}, "a flexible wheelset needs its stiffness"),
    ],
)
def test_vehicles_that_cannot_be_are_refused_before_the_run(sections, sentence):
    with pytest.raises(InputError, match=sentence):
        Scenario(
            vehicle=Vehicle(**sections.get("vehicle", {})),
            suspension=Suspension(**sections.get("suspension", {})),
        )


def test_only_suspended_vehicles_have_series_of_their_bodies():
    suspended = Scenario(vehicle=Vehicle(model="suspended"))
    assert count(suspended).keys() - count(Scenario()).keys() == {"bogie", "car"}
    assert signals_of(Scenario()) == SIGNALS
    more = {signal.name: signal.path(1) for signal in signals_of(suspended)[len(SIGNALS) :]}
    assert more["car_acceleration"] == "vehicle.car.acceleration"
    assert more["bogie_pitch"] == "vehicle.bogie[1].pitch"
    assert more["secondary_force"] == "vehicle.secondary[1].force"


def test_the_example_is_on_the_default_track():
    example = read_scenario(Path(__file__).resolve().parents[2] / "examples" / "coach.toml")
    assert example.track == Track()
