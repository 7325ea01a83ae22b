import numpy as np
import pytest

from orchestrator import MasterSettings
from railcosim.builds import build_for
from railcosim.coupled_system import (
    fmu_sources,
    indicators,
    join,
    located_events,
    master_settings,
    with_steps_for,
)
from railcosim.dataset import count
from railcosim.master_section import Master
from railcosim.motion import speed_law, travel_time
from railcosim.scenario import Scenario
from railcosim.sections import Flat, Run
from railcosim.signals import SIGNALS
from railcosim.start_values import track_values, vehicle_values
from railcosim.track_section import Track
from railcosim.vehicle_section import Vehicle
from vehicle_fmu.speed import SpeedTable

UNITS = {"m": "m", "N": "N", "m s-1": "m/s", "N m": "N.m", "1": None}
"""Units of the CF conventions and their spelling in FMI."""


@pytest.fixture(scope="module")
def fmus(tmp_path_factory):
    folder = tmp_path_factory.mktemp("fmus")
    return lambda scenario: build_for(scenario, directory=folder)


def coupled(scenario, paths, contact="vehicle"):
    law = speed_law(scenario.vehicle)
    return join(fmu_sources(scenario, paths, law, contact=contact), scenario, contact)


@pytest.mark.parametrize(
    "scenario",
    [
        Scenario(),
        Scenario(
            track=Track(bays=12, elements_per_bay=4, mode_pairs=50),
            vehicle=Vehicle(wheels=3, axle_base=0.5),
            flat=Flat(wheel=2),
            run=Run(approach=1.0, departure=1.0),
        ),
    ],
)
def test_fmus_have_every_parameter_connection_signal_and_indicator(scenario, fmus):
    """Start values and connections are checked when the system is made."""
    system = coupled(scenario, fmus(scenario))
    for signal in SIGNALS:
        for k in range(1, count(scenario)[signal.dim] + 1):
            _, variable = system.find(signal.path(k))
            assert variable.unit == UNITS[signal.units], signal.name
    for path in indicators(scenario.vehicle.wheels):
        system.find(path)


def test_no_parameter_of_an_fmu_is_left_to_its_default(fmus):
    """But for the integration and the input shape, which are not the scenario's business.

    Nor are the parameters of supports that are nominal, and the table that they might be in.
    """
    scenario = Scenario()
    law = speed_law(scenario.vehicle)
    given = {
        "track": track_values(scenario, law),
        "vehicle": vehicle_values(scenario, law),
    }
    for participant in coupled(scenario, fmus(scenario)).participants:
        parameters = {
            name
            for name, item in participant.variables.items()
            if item.causality == "parameter" and not name.startswith("support")
        }
        assert parameters - given[participant.name].keys() <= {"substep", "linear_inputs"}


def test_nor_is_one_with_contact_on_the_track_side():
    scenario = Scenario(vehicle=Vehicle(wheels=3), flat=Flat(wheel=2))
    law = speed_law(scenario.vehicle)
    given = {
        "track": track_values(scenario, law, "track"),
        "vehicle": vehicle_values(scenario, law, "track"),
    }
    system = coupled(scenario, build_for(scenario, contact="track"), "track")
    for participant in system.participants:
        parameters = {
            name
            for name, item in participant.variables.items()
            if item.causality == "parameter" and not name.startswith("support")
        }
        assert parameters - given[participant.name].keys() <= {"linear_inputs", "substep"}
    for signal in SIGNALS:
        for k in range(1, count(scenario)[signal.dim] + 1):
            _, variable = system.find(signal.path(k, "track"))
            assert variable.unit == UNITS[signal.units], signal.name
    for path in indicators(3, "track"):
        system.find(path)


@pytest.mark.parametrize(
    ("keys", "algorithm", "step"),
    [
        ({}, "jacobi", 1e-4),
        ({"step": 5e-5}, "jacobi", 5e-5),
        ({"algorithm": "gauss_seidel", "step": 1e-4}, "gauss_seidel", 1e-4),
        ({"algorithm": "newton"}, "newton", None),
    ],
)
def test_contact_on_the_track_side_is_stepped_once_unless_newton_is_named(keys, algorithm, step):
    scenario = with_steps_for(Scenario(master=Master(**keys)), "track")
    settings = master_settings(scenario, "track")
    assert (settings.algorithm, settings.fixed_step) == (algorithm, step)
    explicit = algorithm != "newton"
    assert settings.extrapolate is not explicit
    assert (located_events(scenario, "track") == []) is explicit
    # only a track that steps after the vehicle has the values of the end
    values = track_values(scenario, speed_law(scenario.vehicle), "track")
    assert values.get("linear_inputs", False) is (algorithm == "gauss_seidel")


def test_contact_on_the_vehicle_side_leaves_a_scenario_as_it_is():
    assert with_steps_for(Scenario(), "vehicle") == Scenario()


def test_values_are_converted_to_si_once():
    scenario = Scenario(vehicle=Vehicle(speed_kmh=36.0, axle_load_t=20.0))
    law = speed_law(scenario.vehicle)
    vehicle = vehicle_values(scenario, law)
    assert vehicle["speed"] == pytest.approx(10.0, rel=1e-15)
    assert vehicle["static_wheel_load"] == pytest.approx(98_100.0, rel=1e-15)
    assert vehicle["initial_position"] == pytest.approx(12.7, abs=1e-12)
    assert vehicle["flat.position"] == 16.6
    track = track_values(scenario, law)
    assert track["initial_speed"] == vehicle["speed"]
    assert track["gauge[1].position"] == pytest.approx(16.575, abs=1e-12)


@pytest.mark.parametrize(
    "keys", [{"min_step": 1e-4, "max_step": 1e-4}, {"min_step": 1e-2}, {"initial_step": 1e-7}, {}]
)
def test_steps_that_the_scenario_leaves_open_fit_those_it_gives(keys):
    control = master_settings(Scenario(master=Master(**keys))).make_controller(0.585)
    assert control.min_step <= control.first_step
    if "min_step" in keys:
        assert control.min_step == keys["min_step"]


def test_error_control_is_the_default_and_a_fixed_step_replaces_it():
    settings = master_settings(Scenario(master=Master(tolerance=1e-3, max_step=1e-4)))
    assert isinstance(settings, MasterSettings)
    assert (settings.tolerance, settings.max_step, settings.fixed_step) == (1e-3, 1e-4, None)
    settings = master_settings(Scenario(master=Master(step=1e-4)))
    assert (settings.tolerance, settings.max_step, settings.fixed_step) == (None, None, 1e-4)
    assert settings.min_step < settings.fixed_step


@pytest.mark.parametrize("speed", [1.0, 11.1111, 27.77, 83.3])
@pytest.mark.parametrize("start", [0.0, 1.0])
def test_a_table_of_one_speed_takes_the_time_of_that_speed(speed, start):
    table = SpeedTable(time=np.array([start, start + 0.1]), speed=np.array([speed, speed]))
    assert travel_time(table, 6.5) == pytest.approx(6.5 / speed, rel=1e-9)
