"""What a study file may say, and what it comes to."""

import math

import numpy as np
import pytest

from railcosim.errors import InputError
from railcosim.sweep import parse_study, read_study

GRID = "[sweep.grid]\nvehicle.speed_kmh = [40, 60.5]\n"
MANY = "{ from = 1, to = 2, count = 1001 }"


def speeds(study):
    return [case.scenario.vehicle.speed_kmh for case in study.cases()]


def test_a_grid_is_every_combination_with_the_last_key_changing_first():
    study = parse_study(GRID + "track.ballast = ['linear', 'state_dependent']\n")
    assert study.dims == ("vehicle.speed_kmh", "track.ballast")
    assert study.shape == (2, 2)
    assert speeds(study) == [40.0, 40.0, 60.5, 60.5]
    assert [case.scenario.track.ballast for case in study.cases()] == [
        "linear",
        "state_dependent",
    ] * 2
    assert study.case(2).swept == {"vehicle.speed_kmh": 60.5, "track.ballast": "linear"}


@pytest.mark.parametrize(
    ("given", "values"),
    [
        ("{ from = 5, to = 20, step = 5 }", [5, 10, 15, 20]),
        ("{ from = 20, to = 5, step = -5 }", [20, 15, 10, 5]),
        ("{ from = 0.1, to = 0.7, step = 0.1 }", [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]),
        ("{ from = 10, to = 20, count = 5 }", [10.0, 12.5, 15.0, 17.5, 20.0]),
        ("{ from = 7, to = 7, step = 1 }", [7]),
    ],
)
def test_ranges_hold_both_ends_in_decimal_numbers(given, values):
    study = parse_study(f"[sweep.grid]\nvehicle.speed_kmh = {given}\n")
    assert list(study.grid["vehicle.speed_kmh"]) == values


def test_whole_numbers_stay_whole():
    study = parse_study("[sweep.grid]\ntrack.bays = { from = 40, to = 60, step = 10 }\n")
    assert [case.scenario.track.bays for case in study.cases()] == [40, 50, 60]


def test_listed_cases_are_rows_and_multiply_with_a_grid():
    rows = "[[sweep.list]]\nflat.depth = 1e-3\nflat.length = 0.05\n"
    study = parse_study(f"{rows}{rows.replace('1e-3', '2e-3')}{GRID}")
    assert (study.dims, study.shape) == (("case", "vehicle.speed_kmh"), (2, 2))
    assert [case.scenario.flat.depth for case in study.cases()] == [1e-3, 1e-3, 2e-3, 2e-3]
    assert speeds(study) == [40.0, 60.5] * 2


def random_study(keys, count=2000):
    return parse_study(f"[sweep.random]\ncount = {count}\nseed = 3\n{keys}")


PAD = "track.pad_stiffness = { distribution = 'loguniform', from = 4e7, to = 1.6e8 }\n"
MASS = "vehicle.wheel_mass = { distribution = 'normal', mean = 600, deviation = 20 }\n"
DEPTH = "flat.depth = { distribution = 'uniform', from = 0, to = 1e-3 }\n"


def test_random_cases_have_their_distributions():
    """Means within four standard errors."""
    rows = random_study(PAD + MASS + DEPTH).rows
    pad, mass, depth = (np.array([row[key] for row in rows]) for key in rows[0])
    error = 1.0 / math.sqrt(len(rows))
    assert pad.min() >= 4e7
    assert pad.max() <= 1.6e8
    spread = math.log(4.0) / math.sqrt(12.0)
    assert np.log(pad).mean() == pytest.approx(math.log(8e7), abs=4.0 * error * spread)
    assert mass.mean() == pytest.approx(600.0, abs=4.0 * error * 20.0)
    assert mass.std() == pytest.approx(20.0, rel=4.0 * error / math.sqrt(2.0))
    assert depth.mean() == pytest.approx(5e-4, abs=4.0 * error * 1e-3 / math.sqrt(12.0))
    assert abs(np.corrcoef(mass, depth)[0, 1]) < 4.0 * error


def test_more_random_cases_and_more_keys_keep_the_others():
    """So that what is stored of a smaller study is used by a larger one."""
    few = random_study(PAD, count=5).rows
    more = random_study(MASS + PAD, count=9).rows
    assert [row["track.pad_stiffness"] for row in more[:5]] == [
        row["track.pad_stiffness"] for row in few
    ]


def test_a_base_is_a_file_with_keys_over_it_and_files_lie_beside_what_names_them(tmp_path):
    scenarios = tmp_path / "scenarios"
    scenarios.mkdir()
    (scenarios / "base.toml").write_text(
        "[vehicle]\nwheel_mass = 600\nrail_irregularity = 'rail.csv'\n[flat]\ndepth = 2e-3\n"
    )
    path = tmp_path / "study.toml"
    path.write_text(
        "[base]\nscenario = 'scenarios/base.toml'\nflat.depth = 1e-3\noptions.contact = 'track'\n"
        "[sweep.grid]\nflat.shape = ['cusp', 'tread.csv']\n"
    )
    study = read_study(path)
    first, second = study.cases()
    assert first.scenario.vehicle.wheel_mass == 600.0
    assert first.scenario.flat.depth == 1e-3
    assert first.scenario.vehicle.rail_irregularity == str(scenarios / "rail.csv")
    assert second.scenario.flat.shape == str(tmp_path / "tread.csv")
    assert second.swept == {"flat.shape": "tread.csv"}
    assert first.options.contact == "track"
    assert study.base_text == (scenarios / "base.toml").read_text()


def test_options_of_a_run_can_be_swept():
    study = parse_study(
        "[base]\noptions.fmus = 'python'\n[sweep.grid]\noptions.contact = ['vehicle', 'track']\n"
    )
    assert [case.options.contact for case in study.cases()] == ["vehicle", "track"]


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("", ["sweeps nothing", "[sweep.grid]"]),
        ("[bas]\n", ["bas is no key of a study", "base, sweep, keep"]),
        ("[sweep.girds]\n", ["girds is no key of [sweep]", "grid, list, random"]),
        ("[sweep.grid]\nvehicle.sped = [1]\n", ["vehicle.sped", "did you mean vehicle.speed_kmh"]),
        ("[sweep.grid]\noptions.fmu = ['python']\n", ["options.fmu", "contact, fmus"]),
        ("[sweep.grid]\n'vehicle.speed_kmh' = [1]\n", ["without quotation marks"]),
        ("[sweep.grid]\nvehicle.speed_kmh = 40\n", ["is 40 but must be a list", "from = 5"]),
        ("[sweep.grid]\nvehicle.speed_kmh = []\n", ["has no values"]),
        ("[sweep.grid]\nvehicle.speed_kmh = [40, 40.0]\n", ["40.0 twice"]),
        ("[sweep.grid]\nvehicle.speed_kmh = [[40]]\n", ["plain values"]),
        ("[sweep.grid]\nvehicle.speed_kmh = {from=5, to=9}\n", ["from, to", "step", "count"]),
        ("[sweep.grid]\nvehicle.speed_kmh = {from=5, to=9, step=3}\n", ["whole steps of 3"]),
        ("[sweep.grid]\nvehicle.speed_kmh = {from=5, to=9, step=-1}\n", ["never comes to 9"]),
        ("[sweep.grid]\nvehicle.speed_kmh = {from=5, to=9, step=0}\n", ["never comes to 9"]),
        ("[sweep.grid]\nvehicle.speed_kmh = {from=5, to=9, step=1e-9}\n", ["at most 1000000"]),
        ("[sweep.grid]\nvehicle.speed_kmh = {from=5, to=inf, step=1}\n", ["to is inf", "finite"]),
        ("[sweep.grid]\nvehicle.speed_kmh = {from=5, to=9, count=1}\n", ["at least 2"]),
        (f"[sweep.grid.flat]\nlength = {MANY}\ndepth = {MANY}", ["1002001 cases", "at most 100"]),
        ("[[sweep.list]]\nflat.depth = 1e-3\n[[sweep.list]]\nflat.length = 1\n", ["same keys"]),
        ("[sweep.list]\nflat.depth = 1e-3\n", ["[[sweep.list]]"]),
        (f"{GRID}[[sweep.list]]\nvehicle.speed_kmh = 5\n", ["vehicle.speed_kmh is swept twice"]),
        ("[[sweep.list]]\nflat.depth = 1\n[sweep.random]\ncount = 1\n", ["leave one of them out"]),
        (f"[sweep.random]\nseed = 1\n{PAD}", ["count is missing"]),
        (f"[sweep.random]\ncount = 0\nseed = 1\n{PAD}", ["count is 0", "from 1"]),
        (f"[sweep.random]\ncount = 1\nseed = true\n{PAD}", ["seed is True"]),
        ("[sweep.random]\ncount = 1\nseed = 1\n", ["has no keys"]),
        (f"[sweep.random]\ncount = 1\nseed = 1\n{PAD.replace('log', 'lag')}", ["loguniform"]),
        (f"[sweep.random]\ncount = 1\nseed = 1\n{PAD.replace('4e7', '-1')}", ["above 0"]),
        (f"[sweep.random]\ncount = 1\nseed = 1\n{MASS.replace('20', '0')}", ["above 0"]),
        (f"[sweep.random]\ncount = 1\nseed = 1\n{MASS.replace('mean', 'to')}", ["mean and dev"]),
        ("[sweep.random]\ncount = 1\nseed = 1\nflat.depth = 3\n", ["must be a table such as"]),
        (f"{GRID}[keep]\nsignals = ['in_contact']\nspacing = 1\n", ["contact_force, gap"]),
        (f"{GRID}[keep]\nsignals = 'gap'\nspacing = 1\n", ["a list of names"]),
        (f"{GRID}[keep]\nsignals = ['gap', 'gap']\nspacing = 1\n", ["once"]),
        (f"{GRID}[keep]\nsignals = ['gap']\n", ["keep.spacing is missing"]),
        (f"{GRID}[keep]\nsignals = ['gap']\nspacing = 1e-9\n", ["at least 1e-05 m"]),
        (f"{GRID}[keep]\nsignals = ['gap']\nspacing = true\n", ["keep.spacing is True"]),
        (f"{GRID}[base]\nscenario = 'missing.toml'\n", ["cannot read the scenario"]),
        (f"{GRID}[base]\nscenario = 3\n", ["must be the path"]),
        (f"{GRID}[base]\nwagon.x = 3\n", ["wagon is no section"]),
        ("[sweep", ["not valid TOML"]),
    ],
)
def test_a_wrong_study_is_refused_in_one_sentence(text, parts, tmp_path):
    with pytest.raises(InputError) as caught:
        parse_study(text, folder=tmp_path)
    assert "\n" not in str(caught.value)
    for part in parts:
        assert part in str(caught.value)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("vehicle.speed_kmh = [40, 0.01]", r"^case 2 \(vehicle.speed_kmh = 0.01\): .* at least"),
        ("run.approach = [3.9, 30]", r"^case 2 \(run.approach = 30\): wheel 2 would start"),
        ("options.fmus = ['python', 'fortran']", r"^case 2 .*must be one of python, native"),
    ],
)
def test_a_wrong_case_is_named(text, message):
    study = parse_study(f"[sweep.grid]\n{text}\n")
    with pytest.raises(InputError, match=message):
        list(study.cases())


def test_irregularities_are_of_the_base_and_their_keys_are_swept():
    """A base is not changed by its cases."""
    study = parse_study(
        """
[[base.irregularity]]
kind = "corrugation"
wavelength = 0.06
depth = 20e-6

[sweep.grid]
"irregularity[1]".wavelength = [0.04, 0.08]
"""
    )
    waves = [case.scenario.irregularity[0].wavelength for case in study.cases()]
    assert waves == [0.04, 0.08]
    assert study.base.values["irregularity"][0]["wavelength"] == 0.06
