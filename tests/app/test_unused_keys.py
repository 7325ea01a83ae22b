import math

import pytest

from railcosim.presets import PRESETS
from railcosim.scenario import Scenario
from railcosim.scenario_file import from_toml, read_scenario, to_toml
from railcosim.unused_keys import unused_keys


@pytest.mark.parametrize(
    ("key", "value", "reason", "remedy"),
    [
        ("track.ballast_alpha", 1e11, "track.ballast", ("track.ballast=linear",)),
        ("track.ballast_slope", 1e3, "track.ballast = hyperbolic", ()),
        ("track.ballast_mass_grows", "true", "track.ballast_mass is 0", ()),
        ("track.clip_preload", 1e3, "track.pad is linear", ()),
        ("track.sleeper_elements", 4, "track.sleeper is rigid", ()),
        ("track.sleeper_mass", 99, "sleeper_mass_per_length", ("track.sleeper=beam",)),
        ("variation.seed", 2, "every deviation of [variation] is 0", ()),
        ("variation.correlation_length", 2, "every deviation of [variation] is 0", ()),
        ("variation.transition_begin", 2, "variation.transition_factor is 1", ()),
        ("variation.hanging_gap", 2e-3, "variation.hanging_sleepers names none", ()),
        ("vehicle.bogie_distance", 9, "vehicle.bogies is 1", ()),
        ("vehicle.axle_base", 2, "a bogie has one wheel", ("vehicle.wheels=1",)),
        ("vehicle.youngs_modulus", 2e11, "vehicle.rail_radius or surface.contact_filter", ()),
        ("suspension.tread_damping", 9, "suspension.tread_mass is 0", ()),
        ("suspension.car_mass", 9, "vehicle.model is masses", ()),
        (
            "suspension.primary_clearance",
            0.1,
            "suspension.primary_stop_stiffness is 0",
            ("vehicle.model=suspended",),
        ),
        (
            "suspension.secondary_rebound_ratio",
            2,
            "suspension.secondary_damping is 0",
            ("vehicle.model=suspended", "suspension.secondary_damping=0"),
        ),
        ("flat.periodic", "true", "flat.shape is none", ("flat.shape=none",)),
        ("flat.length", 0.05, "brings both", ("flat.shape=flat.csv",)),
        ("surface.ramp", 2, "there is no [[irregularity]]", ()),
        ("surface.contact_filter", "true", "there is no [[irregularity]], polygon", ()),
        ("keep.stretch", 2, "keep.signals names nothing", ()),
    ],
)
def test_a_key_that_others_leave_without_effect_is_named(key, value, reason, remedy):
    (said,) = unused_keys(read_scenario(None, (*remedy, f"{key}={value}")))
    assert said.startswith(f"{key} has no effect: ")
    assert reason in said


@pytest.mark.parametrize(
    "overrides",
    [
        ("track.ballast=hyperbolic", "track.ballast_slope=1e3"),
        ("track.sleeper=beam", "track.sleeper_elements=4"),
        ("variation.pad_stiffness_deviation=0.1", "variation.seed=2"),
        ("vehicle.rail_radius=0.3", "vehicle.youngs_modulus=2e11"),
        ("vehicle.model=suspended", "suspension.car_mass=9e3"),
        ("variation.hanging_sleepers=25", "variation.hanging_gap=2e-3"),
        ('keep.signals=["gap"]', "keep.spacing=0.1", "keep.stretch=2"),
    ],
)
def test_keys_with_an_effect_are_not_named(overrides):
    assert unused_keys(read_scenario(None, overrides)) == []


def test_several_keys_make_one_sentence():
    (said,) = unused_keys(
        read_scenario(None, ("flat.shape=none", "flat.depth=1e-3", "flat.rolled=true"))
    )
    assert said == "flat.depth, flat.rolled have no effect: flat.shape is none"


@pytest.mark.parametrize("name", PRESETS)
def test_what_a_preset_gives_is_not_the_users(name):
    track = ("track.bays=90", "flat.position=30")
    masses = read_scenario(None, (f"vehicle.preset={name}", "vehicle.model=masses", *track))
    assert unused_keys(masses) == []


def test_a_resolved_scenario_has_no_more_unused_keys():
    assert unused_keys(from_toml(to_toml(Scenario()))) == []


@pytest.mark.parametrize(
    ("keys", "stretch"),
    [
        ('kind = "joint"\nposition = 25.0', "24.5 to 25.5 m"),
        ('kind = "joint"\nposition = 5.0', "4.5 to 5.5 m"),
        ('kind = "iso3095"\nbegin = 20.0', "20 to inf m"),
        ('kind = "german"\nend = 10.0', "-inf to 10 m"),
    ],
)
def test_an_irregularity_that_no_wheel_comes_to_is_named(keys, stretch):
    (said,) = unused_keys(from_toml(f"[[irregularity]]\n{keys}"))
    assert said == (
        f"irregularity[1] has no effect: it lies from {stretch}, but wheels roll over "
        "irregularities from 12.7 to 19.2 m"
    )
    assert unused_keys(from_toml('[[irregularity]]\nkind = "joint"\nposition = 19.6')) == []


def test_a_support_that_an_endless_run_does_not_reach_is_named():
    keys = "[track]\nendless = true\n[variation]\nhanging_sleepers = {}"
    reached = math.ceil(19.2 / 0.65) + 50
    assert unused_keys(from_toml(keys.format(reached))) == []
    (said,) = unused_keys(from_toml(keys.format(reached + 1)))
    key = "variation.hanging_sleepers"
    assert said == f"{key} names support {reached + 1}, but the run reaches {reached} only"
