from dataclasses import replace

import pytest

from railcosim.errors import InputError
from railcosim.master_section import Master
from railcosim.scenario import Scenario
from railcosim.sections import Flat, Run
from railcosim.track_section import Track
from railcosim.variation import Variation
from railcosim.vehicle_section import Vehicle


def test_defaults_are_the_demonstration_example_of_nielsen_and_oscarsson():
    """Table 1 and section 4 of the paper; half an unsprung wheelset of 1185 kg on each wheel."""
    case = Scenario()
    assert case.vehicle.constant_speed == pytest.approx(40.0 / 3.6, rel=1e-15)
    assert case.vehicle.wheel_mass == 1185.0 / 2.0
    assert case.vehicle.static_wheel_load == pytest.approx(117_720.0, rel=1e-15)
    assert (case.track.bays, case.track.length) == (50, 32.5)
    assert (case.flat.shape, case.flat.length, case.flat.depth) == ("haversine", 0.1, 0.9e-3)
    assert case.flat_position == 16.6
    assert case.start_position == pytest.approx(12.7, abs=1e-12)
    assert case.distance == 6.5
    assert case.track.degrees_of_freedom == 847


def test_gauges_are_in_the_struck_bay_and_above_the_sleepers_around_it():
    assert Scenario().struck_bay == 26
    assert Scenario().gauge_positions == pytest.approx((16.575, 16.25, 16.9), abs=1e-12)
    moved = Scenario(flat=Flat(position=20.0))
    assert moved.struck_bay == 31
    assert moved.gauge_positions == pytest.approx((19.825, 19.5, 20.15), abs=1e-12)


def test_a_flat_above_a_sleeper_strikes_the_bay_behind_it():
    assert Scenario(track=Track(sleeper_spacing=0.5), flat=Flat(position=10.0)).struck_bay == 21


def test_bays_are_counted_to_both_ends_of_the_track():
    one = Vehicle(wheels=1)
    assert Scenario(vehicle=one, flat=Flat(position=0.6), run=Run(approach=0.6)).struck_bay == 1
    last = Scenario(flat=Flat(position=32.4), run=Run(departure=0.05))
    assert last.struck_bay == 50
    assert last.gauge_positions[2] == last.track.length


def test_the_leading_wheel_starts_ahead_of_a_flat_on_another_wheel():
    case = Scenario(flat=Flat(wheel=2))
    assert case.start_position == pytest.approx(16.6 - 3.9 + 1.8, abs=1e-12)


def test_every_wheel_may_use_the_whole_track():
    alone = Scenario(vehicle=Vehicle(wheels=1), flat=Flat(position=16.0), run=Run(approach=16.0))
    assert alone.start_position == 0.0
    bogie = Scenario(flat=Flat(position=16.5), run=Run(departure=16.0))
    assert bogie.start_position + bogie.distance == pytest.approx(bogie.track.length, abs=1e-12)


@pytest.mark.parametrize(
    ("sections", "parts"),
    [
        ({"flat": Flat(wheel=3)}, ["flat.wheel is 3", "2 wheels", "vehicle.wheels"]),
        ({"flat": Flat(position=33.0)}, ["33 m", "32.5 m", "track.bays"]),
        ({"flat": Flat(length=40.0)}, ["flat.length is 40 m", "32.5 m", "track", "shorten"]),
        ({"run": Run(approach=15.0)}, ["wheel 2", "-0.2 m", "0 m", "at most 14.8 m", "16.8 m"]),
        ({"run": Run(departure=16.0)}, ["32.6 m", "32.5 m", "at most 15.9 m", "16.5 m"]),
        ({"flat": Flat(position=1.0)}, ["wheel 2", "-4.7 m", "at least 5.7 m"]),
        ({"flat": Flat(wheel=2, position=31.0)}, ["35.4 m", "at most 28.1 m"]),
    ],
)
def test_what_does_not_fit_together_is_refused_with_value_limit_and_remedy(sections, parts):
    with pytest.raises(InputError) as caught:
        Scenario(**sections)
    message = str(caught.value)
    assert "\n" not in message
    for part in parts:
        assert part in message


def test_an_endless_track_has_no_end():
    far = Scenario(
        track=Track(endless=True), flat=Flat(position=5000.0), run=Run(departure=10_000.0)
    )
    assert far.struck_bay == 7693
    assert far.first_bay == 7693 - 26
    assert far.gauge_positions[0] == pytest.approx(7692.5 * 0.65, abs=1e-9)
    assert Scenario(track=Track(endless=True)).first_bay == 0
    with pytest.raises(InputError, match=r"at least 5\.7 m"):
        Scenario(track=Track(endless=True), flat=Flat(position=1.0))


@pytest.mark.parametrize("section", ["approach", "departure"])
def test_following_the_remedy_of_a_run_that_is_too_long_is_accepted(section):
    with pytest.raises(InputError) as caught:
        Scenario(run=Run(**{section: 31.0}))
    limit = float(str(caught.value).split("at most ")[1].split(" m")[0])
    Scenario(run=Run(**{section: limit}))


def test_a_round_wheel_needs_no_fitting_flat():
    round_wheel = Scenario(flat=Flat(shape="none", length=40.0))
    assert round_wheel.flat.length > round_wheel.track.length


def test_more_modes_than_degrees_of_freedom_are_refused():
    Track(bays=2, elements_per_bay=1, mode_pairs=3)
    with pytest.raises(InputError, match="only 3 mode pairs"):
        Track(bays=2, elements_per_bay=1, mode_pairs=4)


def test_speed_and_speed_table_exclude_each_other():
    with pytest.raises(InputError, match="both given: leave one of them out"):
        Vehicle(speed_kmh=50.0, speed_table="speed.csv")


def test_fixed_step_and_step_limits_exclude_each_other():
    with pytest.raises(InputError, match="leave either it or them out"):
        Master(step=1e-4, max_step=1e-3)


def test_step_limits_must_be_in_order():
    Master(min_step=1e-6, initial_step=1e-6, max_step=1e-6)
    with pytest.raises(InputError, match=r"master\.min_step is 0\.001 s .* 0\.0001 s"):
        Master(min_step=1e-3, max_step=1e-4)


def test_positions_on_an_endless_track_keep_their_digits():
    track = Track(endless=True)
    far = Scenario(track=track, flat=Flat(position=9.9e8))
    assert far.supports == 49  # they are all alike, however many there are
    with pytest.raises(InputError, match=r"would end at 2e\+09 m but .* at most 1e\+09 m: shorten"):
        Scenario(track=track, flat=Flat(position=2e9))


def test_only_so_many_supports_of_an_endless_track_can_vary():
    track, flat = Track(endless=True), Flat(position=1e8)
    with pytest.raises(InputError, match=r"153846\d\d\d supports .* at most 2000000 can"):
        Scenario(track=track, flat=flat, variation=Variation(pad_stiffness_deviation=0.1))
    repeated = replace(track, supports="supports.csv", supports_repeat=True)
    assert Scenario(track=repeated, flat=flat).supports == 2_000_000
