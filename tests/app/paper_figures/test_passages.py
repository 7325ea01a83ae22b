import numpy as np
import pytest
import xarray as xr

from railcosim.errors import InputError, RunError
from railcosim.paper_figures.measured_peaks import read_measured_peaks
from railcosim.paper_figures.passages import parse_speeds, peaks_of, speed_study
from railcosim.scenario_file import read_scenario, to_toml


@pytest.mark.parametrize(
    ("text", "speeds"),
    [
        ("5:100:5", tuple(np.arange(5.0, 101.0, 5.0))),
        ("30:31:0.5", (30.0, 30.5, 31.0)),
        ("40", (40.0,)),
        ("70,30", (70.0, 30.0)),
    ],
)
def test_speeds_are_ranges_or_lists(text, speeds):
    assert parse_speeds(text) == speeds


@pytest.mark.parametrize("text", ["", "fast", "5:100", "5:100:7", "5:100:-5", "5:6:1:1", "40,40"])
def test_what_is_no_set_of_speeds_is_refused(text):
    with pytest.raises(InputError, match="speed"):
        parse_speeds(text)


def test_a_study_holds_both_tracks_at_every_speed_and_the_rest_as_given():
    scenario = read_scenario(None, ["flat.shape=parabola", "flat.depth=1e-3", "track.bays=30"])
    study = speed_study(scenario, (20.0, 40.0), "python")
    cases = list(study.cases())
    found = [(c.scenario.vehicle.speed_kmh, c.scenario.track.ballast) for c in cases]
    assert found == [
        (20.0, "state_dependent"),
        (20.0, "linear"),
        (40.0, "state_dependent"),
        (40.0, "linear"),
    ]
    assert to_toml(cases[2].scenario) == to_toml(scenario)
    assert {case.options.fmus for case in cases} == {"python"}


def test_speeds_beyond_the_limits_or_from_a_table_are_refused(tmp_path):
    study = speed_study(read_scenario(), (2000.0,))
    with pytest.raises(InputError, match=r"vehicle\.speed_kmh is 2000"):
        study.case(0)
    table = tmp_path / "speed.csv"
    table.write_text("0,10\n1,11\n")
    scenario = read_scenario(None, [f"vehicle.speed_table={table}"])
    with pytest.raises(InputError, match="the figures choose the speed"):
        speed_study(scenario, (20.0,))


def test_peaks_are_over_speed_and_ballast_and_failures_end_the_figures():
    failure = np.array([["", ""], ["", "it diverged"]])
    result = xr.Dataset(
        {"failure": (("vehicle.speed_kmh", "track.ballast"), failure)},
        {"vehicle.speed_kmh": [20.0, 40.0], "track.ballast": ["state_dependent", "linear"]},
    )
    with pytest.raises(RunError, match=r"at 40 km/h on the linear track: it diverged"):
        peaks_of(result)
    assert peaks_of(result.isel({"vehicle.speed_kmh": [0]})).sizes == {"speed_kmh": 1, "ballast": 2}


def test_measured_peaks_are_speed_force_and_perhaps_moment(tmp_path):
    both, force = tmp_path / "campaign.csv", tmp_path / "forces.csv"
    both.write_text("speed;force;moment\n40;2.3e5;3.6e4\n30;2.2e5;3.5e4\n")
    force.write_text("# no gauges\n40 2.3e5\n")
    measured = read_measured_peaks(both)
    assert measured.speed.tolist() == [40.0, 30.0]
    assert measured.contact_force.tolist() == [2.3e5, 2.2e5]
    assert measured.bending_moment.tolist() == [3.6e4, 3.5e4]
    assert measured.name == "measured (campaign)"
    assert read_measured_peaks(force).bending_moment is None


@pytest.mark.parametrize(
    ("text", "message"),
    [("-5,1e5\n", "must be above 0 km/h"), ("40\n", "has 1 values, not 2"), ("", "has no rows")],
)
def test_a_file_that_is_no_such_table_is_refused(tmp_path, text, message):
    path = tmp_path / "x.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=message):
        read_measured_peaks(path)
