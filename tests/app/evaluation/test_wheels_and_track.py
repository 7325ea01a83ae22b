"""Numbers of wheels, gauges and supports, of passages made by hand."""

import numpy as np
import pytest

from railcosim.evaluation.gauges import gauge_histories
from railcosim.evaluation.settings import Evaluation
from railcosim.evaluation.supports import support_loads
from railcosim.evaluation.wheels import wheel_loads
from railcosim.scenario import Scenario
from railcosim.track_section import Track
from railcosim.vehicle_section import Vehicle

DISTANCE = np.array([-1.0, 0.0, 1.0, 2.0])
SPEED = 10.0
SCENARIO = Scenario(
    vehicle=Vehicle(speed_kmh=36.0, axle_load_t=20.0), track=Track(bending_stiffness=5e6)
)


def test_the_dynamic_factor_is_the_peak_over_the_static_load(make_passage):
    force = {1: [9e4, 1e4, 2.4525e5, 9e4], 2: [9.81e4] * 4}
    found = wheel_loads(make_passage(DISTANCE, SCENARIO, series={"contact_force": force}))
    np.testing.assert_allclose(found["dynamic_factor"], [2.5, 1.0], rtol=1e-12)
    assert found["max_contact_force"].to_numpy().tolist() == [2.4525e5, 9.81e4]
    assert found["min_contact_force"].to_numpy().tolist() == [1e4, 9.81e4]
    assert found["max_contact_force"].attrs["long_name"] == "largest wheel-rail contact force"


def test_losses_of_contact_are_counted_and_timed(make_passage):
    """The gap is above zero from 1/2 to 3/2 of a step, then from 5/2 of a step to the end."""
    gap = {1: [-1e-4, 1e-4, -1e-4, 1e-4], 2: [-1e-4] * 4}
    found = wheel_loads(make_passage(DISTANCE, SCENARIO, series={"gap": gap}))
    assert found["contact_losses"].to_numpy().tolist() == [2, 0]
    np.testing.assert_allclose(found["loss_of_contact_time"], [1.5 / SPEED, 0.0], rtol=1e-12)
    np.testing.assert_allclose(found["longest_loss_of_contact"], [1.0 / SPEED, 0.0], rtol=1e-12)


def test_the_strain_is_that_of_a_beam(make_passage):
    moment = {2: [0.0, 1e4, -5e3, 0.0]}
    passage = make_passage(DISTANCE, SCENARIO, series={"bending_moment": moment})
    found = gauge_histories(passage, Evaluation(gauge_depth=0.08))
    strain = found["strain"].sel(gauge=2)
    np.testing.assert_allclose(strain, [0.0, 1.6e-4, -0.8e-4, 0.0], rtol=1e-12)
    assert float(found["max_strain"].sel(gauge=2)) == pytest.approx(1.6e-4, rel=1e-12)
    assert float(found["min_bending_moment"].sel(gauge=2)) == -5e3
    head = gauge_histories(passage, Evaluation(gauge_depth=-0.08))["strain"]
    np.testing.assert_array_equal(head, -found["strain"])


def test_the_usual_gauge_is_under_the_foot_of_a_uic60_rail(make_passage):
    """Strain times E is then the moment over the section modulus of the foot, 375.5 cm3."""
    e_modulus, second_moment = 210e9, 3038.3e-8
    scenario = Scenario(track=Track(bending_stiffness=e_modulus * second_moment))
    passage = make_passage(DISTANCE, scenario, series={"bending_moment": {1: [1e4] * 4}})
    stress = e_modulus * float(gauge_histories(passage)["max_strain"].sel(gauge=1))
    assert stress == pytest.approx(1e4 / 375.5e-6, rel=3e-4)


def test_every_support_tells_the_most_it_carries(make_passage):
    series = {
        "pad_force": {3: [0.0, 5e4, -2e3, 0.0]},
        "ballast_force": {4: [1.0, 3e4, 2e4, 1.0]},
        "sleeper_displacement": {4: [0.0, 4e-4, 1e-4, 0.0]},
    }
    found = support_loads(make_passage(DISTANCE, SCENARIO, series=series))
    assert float(found["max_pad_force"].sel(sleeper=3)) == 5e4
    assert float(found["min_pad_force"].sel(sleeper=3)) == -2e3
    assert float(found["max_ballast_force"].sel(sleeper=4)) == 3e4
    assert float(found["min_ballast_force"].sel(sleeper=4)) == 1.0
    assert float(found["max_sleeper_displacement"].sel(sleeper=4)) == 4e-4
    assert float(found["sleeper_position"].sel(sleeper=4)) == pytest.approx(4 * 0.65)
