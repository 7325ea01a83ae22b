import numpy as np
import pytest

from railcosim.evaluation.settings import Evaluation
from railcosim.evaluation.wheel_load_detector import wheel_load_record
from railcosim.scenario import Scenario
from railcosim.sections import Flat
from railcosim.vehicle_section import Vehicle

STATIC = 1e5
SPACING = 0.65
STRUCK = 26


@pytest.fixture
def passage(record):
    """One wheel over 5.6 m around the flat, 20 kN above the static load in the struck bay."""
    scenario = Scenario(vehicle=Vehicle(wheels=1))

    def force(t):
        place = scenario.flat_position + 40.0 / 3.6 * (t - 0.25)
        return STATIC + 2e4 * (np.floor(place / SPACING) == STRUCK - 1)

    return record(force, scenario=scenario)


def test_nine_bays_around_the_struck_one_at_six_kilohertz(passage):
    found = wheel_load_record(passage)
    assert found["bay"].to_numpy().tolist() == list(range(STRUCK - 4, STRUCK + 5))
    assert float(found["bay_position"].sel(bay=STRUCK)) == pytest.approx(25.5 * SPACING)
    np.testing.assert_allclose(np.diff(found["record_time"]), 1.0 / 6000.0, rtol=1e-9)


def test_every_bay_sees_the_wheel_while_it_is_there(passage):
    found = wheel_load_record(passage)
    force = found["bay_force"]
    position = passage["wheel_position"].sel(wheel=1).interp(time=found["record_time"])
    bay = np.floor(position / SPACING) + 1
    clear = np.abs(position / SPACING - (position / SPACING).round()).to_numpy() > 1e-9
    for number in found["bay"].to_numpy():
        seen = force.sel(bay=number).to_numpy() > 0.0
        np.testing.assert_array_equal(seen[clear], (bay == number).to_numpy()[clear])


def test_the_readings_of_a_bay_are_its_largest_and_mean_force(passage):
    found = wheel_load_record(passage).sel(wheel=1)
    inner = slice(STRUCK - 3, STRUCK + 3)
    away = found.sel(bay=inner).drop_sel(bay=[STRUCK - 1, STRUCK, STRUCK + 1])
    np.testing.assert_allclose(away["bay_mean_force"], STATIC, rtol=1e-3)
    struck = found.sel(bay=STRUCK)
    # a step in the force swings over by 9 % of itself once it is band-limited
    assert float(struck["bay_max_force"]) == pytest.approx(1.2e5 + 0.09 * 2e4, rel=5e-3)
    assert float(struck["bay_mean_force"]) == pytest.approx(1.2e5, rel=5e-3)
    ratio = struck["bay_max_force"] / struck["bay_mean_force"]
    assert float(struck["bay_dynamic_factor"]) == float(ratio)


def test_a_bay_that_the_run_does_not_reach_says_so(passage):
    """The wheel rolls from 13.82 m to 19.38 m, the bays reach from 13.65 m to 19.50 m."""
    found = wheel_load_record(passage).sel(wheel=1)
    seen = found["bay_seen"].to_numpy()
    np.testing.assert_allclose(seen[1:-1], 1.0, rtol=1e-12)
    start, end = 16.6 - 0.25 * 40.0 / 3.6, 16.6 + 0.25 * 40.0 / 3.6
    assert seen[0] == pytest.approx((21 * SPACING + SPACING - start) / SPACING, abs=1e-9)
    assert seen[-1] == pytest.approx((end - 29 * SPACING) / SPACING, abs=1e-9)
    more = wheel_load_record(passage, Evaluation(bays=11)).sel(wheel=1)
    assert more["bay_seen"].to_numpy()[[0, -1]].tolist() == [0.0, 0.0]
    assert np.isnan(more["bay_max_force"].to_numpy()[[0, -1]]).all()
    assert np.isfinite(more["bay_max_force"].to_numpy()[1:-1]).all()


def test_gauges_in_the_middle_of_a_bay_miss_what_happens_at_its_ends(record):
    scenario = Scenario(vehicle=Vehicle(wheels=1))

    def force(t):
        place = (scenario.flat_position + 40.0 / 3.6 * (t - 0.25)) / SPACING % 1.0
        return STATIC + 5e4 * (np.abs(place - 0.5) > 0.4)

    passage = record(force, scenario=scenario)
    whole = wheel_load_record(passage).sel(bay=STRUCK, wheel=1)
    half = wheel_load_record(passage, Evaluation(bay_share=0.5)).sel(bay=STRUCK, wheel=1)
    assert float(whole["bay_max_force"]) > 1.45e5
    assert float(half["bay_max_force"]) == pytest.approx(STATIC, rel=0.02)
    assert float(half["bay_seen"]) == pytest.approx(1.0, rel=1e-12)


def test_wheels_in_the_same_bay_are_weighed_together(record, tone):
    scenario = Scenario(vehicle=Vehicle(axle_base=0.3))
    passage = record(tone(0.0, 1.0), tone(0.0, 1.0, static=7e4), scenario=scenario)
    found = wheel_load_record(passage)
    assert float(found["bay_force"].max()) == pytest.approx(1.7e5, rel=1e-9)
    largest = found["bay_max_force"].sel(bay=STRUCK)
    np.testing.assert_allclose(largest, [1e5, 7e4], rtol=1e-9)


def test_bays_beyond_the_track_are_left_out(record, tone):
    scenario = Scenario(vehicle=Vehicle(wheels=1), flat=Flat(position=4.0))
    found = wheel_load_record(record(tone(0.0, 1.0), scenario=scenario), Evaluation(bays=21))
    assert found["bay"].to_numpy().tolist() == list(range(1, 18))


def test_a_strike_too_short_for_six_kilohertz_is_read_lower(record):
    """A triangle of 0.1 ms holds more than the anti-aliasing filter passes."""
    passage = record(lambda t: STATIC + 1e5 * np.maximum(0.0, 1.0 - np.abs(t - 0.25) / 1e-4))
    found = wheel_load_record(passage).sel(bay=STRUCK, wheel=1)
    # through an ideal low-pass at 2.7 kHz the area of 10 Ns makes 10 Ns * 2 * 2.7 kHz at most
    assert float(found["bay_max_force"]) < STATIC + 10.0 * 2.0 * 2700.0 * 1.05
    assert float(found["bay_max_force"]) > STATIC + 0.7 * 10.0 * 2.0 * 2700.0
