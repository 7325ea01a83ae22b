"""What a scenario says of its supports, and of their pads."""

import json
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from railcosim import cli
from railcosim.errors import InputError
from railcosim.input_tables import check_laws
from railcosim.motion import speed_law
from railcosim.pad_curves import pad_loops
from railcosim.scenario_file import read_scenario
from railcosim.start_values import track_values
from railcosim.support_values import random_factors, support_properties, support_values
from railcosim.surfaces.tables import write_supports
from railcosim.track_data import is_linear
from railcosim.variation import Variation

PAD = Path(__file__).resolve().parents[2] / "examples" / "pad.csv"


def test_a_uniform_track_sets_no_parameter():
    assert support_values(read_scenario()) == {}


def test_tables_and_lists_are_multiplied_and_merged(tmp_path):
    table = tmp_path / "supports.csv"
    table.write_text("position;pad_stiffness_factor;gap\n# comment\n6.5;0.5;0\n7.2;2;1e-3\n")
    scenario = read_scenario(
        None,
        [
            f"track.supports={table}",
            "variation.hanging_sleepers=3-4",
            "variation.hanging_gap=2e-3",
            "variation.missing_fastenings=10",
            "variation.transition_begin=31",
            "variation.transition_factor=3",
        ],
    )
    assert support_values(scenario) == {
        "support[10].pad_stiffness_factor": 0.5,
        "support[11].pad_stiffness_factor": 2.0,
        "support[3].gap": 2e-3,
        "support[4].gap": 2e-3,
        "support[11].gap": 1e-3,
        "support[10].fastened": False,
        **{
            f"support[{i}].ballast_{name}_factor": 3.0
            for i in (48, 49)
            for name in ("stiffness", "damping")
        },
    }


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "is empty"),
        ("number,colour\n1,2\n", "column 'colour' is unknown"),
        ("gap\n1e-3\n", "must have one of the columns number and position"),
        ("number,gap\n1,-1\n", "line 2: gap is '-1', not a number of at least 0"),
        ("number,gap\n50,0\n", "names support 50 but the track has 49"),
        ("number,gap\n1,0\n1,0\n", "line 3: support 1 has a row already"),
        ("number,sleeper_mass_factor\n7,0.05\n", r"0.05 of support 7 .* at least 0\.1"),
        ("number,gap\n1.5,0\n", "number is 1.5, not a whole number"),
        ("number,gap\n1\n", "has 1 values, not 2"),
    ],
)
def test_wrong_tables_are_refused(tmp_path, text, sentence):
    table = tmp_path / "supports.csv"
    table.write_text(text)
    with pytest.raises(InputError, match=sentence):
        check_laws(read_scenario(None, [f"track.supports={table}"]))


@pytest.mark.parametrize(
    ("keys", "sentence"),
    [
        (
            ["variation.hanging_sleepers=7", "variation.missing_fastenings=6-8"],
            "support 7 is held by nothing: there is a gap of 0.001 m under it and the rail is not",
        ),
        (
            ["variation.hanging_sleepers=7-9", "variation.missing_pads=9"],
            "support 9 is held by nothing: there is a gap of 0.001 m under it and no pad ties it",
        ),
    ],
)
def test_sleepers_that_nothing_holds_are_refused(keys, sentence):
    with pytest.raises(InputError, match=sentence):
        support_properties(read_scenario(None, keys))


def test_a_sleeper_without_pad_lies_on_ballast_that_does_not_pull():
    keys = ["track.ballast_pulls=false", "variation.missing_pads=9"]
    assert support_properties(read_scenario(None, keys))["pad_stiffness_factor"][8] == 0.0


def test_an_endless_track_has_the_supports_that_the_passage_reaches(tmp_path):
    """Those of a list beyond it, however many, are left out; a table may be repeated."""
    table = tmp_path / "supports.csv"
    table.write_text("number,pad_stiffness_factor\n2,0.5\n10,3\n")
    keys = [
        f"track.supports={table}",
        "track.supports_repeat=true",
        "track.endless=true",
        "flat.position=100",
        "variation.hanging_sleepers=160, 205-999999",
    ]
    own = support_properties(read_scenario(None, keys))
    count = len(own["gap"])
    assert 158 + 25 <= count <= 158 + 60
    assert own["pad_stiffness_factor"][[1, 9, 11, 19, 101]].tolist() == [0.5, 3.0, 0.5, 3.0, 0.5]
    assert np.flatnonzero(own["gap"]).tolist() == [159, *range(204, count)]


def test_an_endless_passage_passes_its_supports_on_as_a_file(tmp_path):
    """One that has no variation names the table itself, as a package does."""
    table = tmp_path / "supports.csv"
    table.write_text("number,gap\n200,1e-3\n")
    endless = ["track.endless=true", f"track.supports={table}", "track.supports_repeat=true"]
    named, written = (
        read_scenario(None, [*endless, *keys]) for keys in ([], ["variation.missing_pads=3"])
    )
    law = speed_law(named.vehicle)
    values = track_values(named, law)
    assert (values["supports"], values["supports_repeat"]) == (str(table), True)
    with pytest.raises(InputError, match=r"\[variation\] on an endless track is written for a run"):
        track_values(written, law)
    path = write_supports(tmp_path / "all.csv", written)
    again = support_properties(
        read_scenario(None, ["track.endless=true", f"track.supports={path}"])
    )
    own = support_properties(written)
    assert all(np.array_equal(again[name], values) for name, values in own.items())
    assert own["pad_stiffness_factor"][2] == 0.0
    assert read_scenario(None, ["track.endless=true", "track.sleeper=beam"]).track.endless


@pytest.mark.parametrize(
    ("override", "sentence"),
    [
        ("variation.missing_pads=50", "names support 50 but the track has 49"),
        ("variation.missing_pads=3-1", "whole numbers from 1 on"),
        ("variation.missing_pads=a", "whole numbers from 1 on"),
        ("track.supports_repeat=true", "track.supports names no file that could be repeated"),
        ("track.pad=rubber", "one of linear or a FILE.csv"),
        ("track.ballast_mass=-1", "track.ballast_mass"),
        ("variation.sleeper_mass_deviation=0.6", "variation.sleeper_mass_deviation"),
    ],
)
def test_wrong_keys_are_refused(override, sentence):
    with pytest.raises(InputError, match=sentence):
        read_scenario(None, [override])


def test_masses_of_sleepers_are_multiplied_and_have_random_numbers_of_their_own(tmp_path):
    table = tmp_path / "supports.csv"
    table.write_text("number,sleeper_mass_factor\n3,2\n")
    keys = ["variation.sleeper_mass_deviation=0.2", "variation.pad_stiffness_deviation=0.2"]
    alone = support_properties(read_scenario(None, keys))
    own = support_properties(read_scenario(None, [*keys, f"track.supports={table}"]))
    ratio = own["sleeper_mass_factor"] / alone["sleeper_mass_factor"]
    assert ratio.tolist() == [2.0 if i == 2 else 1.0 for i in range(49)]
    logarithms = [np.log(alone[f"{name}_factor"]) for name in ("sleeper_mass", "pad_stiffness")]
    assert logarithms[0].std() == pytest.approx(0.2, rel=0.3)
    assert not np.allclose(*logarithms)


def test_masses_of_sleepers_that_bend_are_refused():
    keys = ["track.sleeper=beam", "variation.sleeper_mass_deviation=0.2"]
    with pytest.raises(InputError, match="sleepers bend, but their masses differ"):
        check_laws(read_scenario(None, keys))


def test_random_factors_have_the_deviation_and_the_correlation_asked_for():
    """Over 40 000 supports a correlation is known to about 1 %."""
    variation = Variation(seed=3, correlation_length=2.0)
    positions = 0.65 * np.arange(1, 40_001)
    logarithm = np.log(random_factors(variation, positions, 0.4, 0))
    assert logarithm.std() == pytest.approx(0.4, rel=0.03)
    for lag in (1, 3, 6):
        found = np.corrcoef(logarithm[lag:], logarithm[:-lag])[0, 1]
        assert found == pytest.approx(np.exp(-0.65 * lag / 2.0), abs=0.04)
    again = random_factors(variation, positions, 0.4, 0)
    assert np.array_equal(np.log(again), logarithm)
    other = np.log(random_factors(variation, positions, 0.4, 1))
    assert abs(np.corrcoef(logarithm, other)[0, 1]) < 0.04


def test_all_seeds_leave_the_nominal_track_where_nothing_deviates():
    own = support_properties(read_scenario(None, ["variation.seed=7"]))
    assert all((values == (0.0 if name == "gap" else 1.0)).all() for name, values in own.items())


@pytest.mark.parametrize(
    ("override", "linear"),
    [
        ("variation.missing_pads=3", True),
        ("variation.hanging_sleepers=3", False),
        ("variation.missing_fastenings=3", False),
        ("track.ballast_pulls=false", False),
        (f"track.pad={PAD}", False),
    ],
)
def test_a_track_is_linear_where_nothing_bends_or_opens(override, linear):
    assert is_linear(read_scenario(None, ["track.ballast=linear", override])) == linear
    assert not is_linear(read_scenario(None, [override]))


def test_small_loops_have_the_stiffness_of_the_three_parameters():
    """Storage and loss of the standard linear solid; a loop of 5 % of the load sees other ones."""
    track = read_scenario(None, [f"track.pad={PAD}"]).track
    for loop, k0 in zip(pad_loops(track, 100.0), (20e6, 26e6, 33e6, 50e6, 70e6), strict=True):
        relaxed = 2j * np.pi * 100.0 * 0.01
        expected = k0 * (1.0 + 3.0 * relaxed / (1.0 + relaxed))
        assert loop.static_stiffness == pytest.approx(k0, rel=1e-3)
        assert loop.dynamic_stiffness == pytest.approx(abs(expected), rel=0.02)
        assert loop.loss_factor == pytest.approx(expected.imag / expected.real, rel=0.02)
        assert loop.load[0] == pytest.approx(loop.load[-1], rel=1e-4)


def test_the_command_prints_numbers_and_draws_the_pad(tmp_path):
    plot = tmp_path / "pad.png"
    command = ["pad", "--set", f"track.pad={PAD}", "--json", "--plot", str(plot)]
    answer = CliRunner().invoke(cli.app, command)
    assert answer.exit_code == 0, answer.stderr
    numbers = json.loads(answer.stdout)
    assert [row["preload"] for row in numbers["preloads"]] == [20e3, 30e3, 40e3, 60e3, 80e3]
    assert plot.stat().st_size > 1e4
    refused = CliRunner().invoke(cli.app, ["pad"])
    assert refused.exit_code == 2
    assert "track.pad is linear, which has no loop" in refused.stderr
