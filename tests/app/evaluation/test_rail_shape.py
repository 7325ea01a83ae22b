import numpy as np
import pytest

from railcosim.errors import InputError
from railcosim.evaluation.rail_shape import rail_shape
from railcosim.passage import run_passage
from railcosim.scenario import Scenario
from railcosim.scenario_file import read_scenario
from railcosim.sections import Flat
from railcosim.track_section import Track
from railcosim.vehicle_section import Vehicle

MIDSPAN = 25.5 * 0.65
ROUNDING = 1e-14  # m: what two programs differ by in sums of millimetres


@pytest.fixture(scope="module")
def passage():
    """The strike of the flat, run with FMUs."""
    return run_passage(
        read_scenario(None, ["run.approach=0.3", "run.departure=0.2", "flat.depth=2e-3"])
    )


def test_the_rail_under_every_wheel_is_where_the_run_recorded_it(passage):
    recorded = passage.isel(time=slice(0, None, 40))
    for wheel in (1, 2):
        at = recorded["wheel_position"].sel(wheel=wheel).to_numpy()
        shape = rail_shape(passage, recorded["time"], at)
        under = recorded["rail_displacement"].sel(wheel=wheel)
        np.testing.assert_allclose(np.diag(shape), under, rtol=0.0, atol=ROUNDING)
        assert shape.attrs["largest_deviation"] < ROUNDING


def test_between_the_points_of_the_run_the_rail_moves_on_smoothly(passage):
    """What is seen at the middle of a step is off the chord by the rail's acceleration alone."""
    times = passage["time"].to_numpy()
    longest = np.argmax(np.diff(times))
    start, end = times[longest : longest + 2]
    at = float(passage["wheel_position"].isel(time=longest, wheel=0))
    shape = rail_shape(passage, [start, 0.5 * (start + end), end], [at])[:, 0].to_numpy()
    sag = np.abs(shape[1] - 0.5 * (shape[0] + shape[2]))
    assert sag < 0.05 * np.abs(shape[2] - shape[0]) + 1e-8


def test_a_chosen_time_does_not_change_what_comes_after_it(passage):
    end = passage["time"].to_numpy()[-1]
    some = np.linspace(0.0, end, 37)
    at = np.linspace(15.0, 18.0, 7)
    alone = rail_shape(passage, [end], at)
    np.testing.assert_array_equal(rail_shape(passage, some, at)[-1], alone[0])


@pytest.mark.parametrize(("ballast", "deflection"), [("state_dependent", 1.167), ("linear", 1.982)])
def test_one_standing_wheel_bends_the_rail_as_much_as_in_statics(make_passage, ballast, deflection):
    """The known static deflections at midspan [mm], of a full finite element track."""
    scenario = Scenario(
        track=Track(ballast=ballast),
        vehicle=Vehicle(wheels=1, speed_kmh=0.1),
        flat=Flat(position=MIDSPAN),
    )
    load = scenario.vehicle.static_wheel_load
    passage = make_passage([0.0, 1e-9], scenario, series={"contact_force": {1: np.full(2, load)}})
    away = np.linspace(0.0, 5.0, 21)
    shape = rail_shape(passage, [0.0], np.concatenate((MIDSPAN + away, MIDSPAN - away)))[0]
    right, left = np.split(shape.to_numpy(), 2)
    assert 1e3 * right[0] == pytest.approx(deflection, abs=6e-4)  # its last digit
    # the way at 0.1 km/h leaves a trace of the ballast's damping
    np.testing.assert_allclose(right, left, atol=1e-6)
    assert np.abs(right[-1]) < 0.05 * right[0]


def test_clamped_ends_stay_where_they_are(passage):
    shape = rail_shape(passage, [0.01], [0.0, 32.5])
    assert np.abs(shape).max() == 0.0


@pytest.mark.parametrize(
    ("times", "positions", "message"),
    [
        ([1.0], [1.0], "the rail is wanted at 1 s but the run lasts from 0 s to 0.045 s"),
        ([np.nan], [1.0], "the rail is wanted at nan s"),
        ([0.02, 0.01], [1.0], "do not increase"),
        ([0.0], [33.0], "position 33.0 m lies outside the track of 0 to 32.5 m"),
    ],
)
def test_what_is_not_there_is_refused(passage, times, positions, message):
    with pytest.raises(InputError, match=message):
        rail_shape(passage, times, positions)
