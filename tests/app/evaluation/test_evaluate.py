"""The evaluation as a whole: its parts together, and the command."""

import json

import numpy as np
import pyarrow.parquet as pq
import pytest
import xarray as xr
from scipy.io import loadmat
from typer.testing import CliRunner

from railcosim import cli
from railcosim.errors import InputError
from railcosim.evaluation.parts import PARTS, evaluate
from railcosim.evaluation.settings import Evaluation, PartName
from railcosim.figures.evaluation import DRAWERS, draw_evaluation
from railcosim.output import write_dataset


@pytest.fixture
def passage(record, tone):
    return record(tone(2e4, 500.0), tone(1e3, 100.0), step=1e-4)


@pytest.fixture
def stored(passage, tmp_path):
    path = tmp_path / "passage.nc"
    write_dataset(passage, path)
    return path


@pytest.fixture
def call(stored):
    def call(*arguments, result=stored):
        texts = ["evaluate", str(result), *map(str, arguments)]
        return CliRunner().invoke(cli.app, texts)

    return call


def one_sentence(result):
    (line,) = result.stderr.splitlines()
    assert line.startswith("railcosim: ")
    return line


def test_every_part_can_be_made_and_drawn():
    assert set(PARTS) == set(DRAWERS) == set(PartName)


@pytest.mark.parametrize("part", PartName)
def test_a_part_is_the_same_alone_and_among_the_others(passage, part):
    alone, everything = evaluate(passage, part=part), evaluate(passage)
    assert PARTS[part].along in alone.dims
    for name, variable in alone.variables.items():
        xr.testing.assert_identical(variable, everything.variables[name])
        assert {"units", "long_name", "sign"} <= set(variable.attrs), name
    assert alone.attrs["scenario"] == passage.attrs["scenario"]


@pytest.mark.parametrize("part", [None, *PartName])
def test_every_part_has_a_picture(passage, part):
    figure = draw_evaluation(evaluate(passage, part=part), part, "title")
    assert len(figure.axes) == (4 if part is None else 1)
    for axes in figure.axes:
        assert axes.get_ylabel()
        assert axes.get_xlabel()
        assert len(axes.lines) + len(axes.patches) > 0


def test_the_result_of_something_else_is_refused():
    other = xr.Dataset({"ball.height": ("time", [0.0, 1.0])}, {"time": [0.0, 1.0]})
    with pytest.raises(InputError, match="is not the result of a passage"):
        evaluate(other)


def test_json_has_the_numbers_and_on_request_a_whole_part(call):
    numbers = json.loads(call("--json").stdout)
    assert numbers["wheel"] == [1, 2]
    assert numbers["dynamic_factor"][0] == pytest.approx(1.2e5 / 117720.0, rel=1e-3)
    assert len(numbers["bay_max_force"]) == 9
    assert numbers["bay_max_force"][-1][1] is None  # the second wheel does not get there
    assert "contact_force_amplitude" not in numbers
    spectrum = json.loads(call("--json", "--part", "spectrum").stdout)
    assert set(spectrum) == {
        "contact_force_amplitude",
        "contact_force_density",
        "frequency",
        "wheel",
    }
    line = spectrum["frequency"].index(500.0)
    assert spectrum["contact_force_amplitude"][line][0] == pytest.approx(2e4, rel=0.02)


def test_the_table_names_what_engineers_look_for(call):
    result = call()
    assert result.exit_code == 0
    for text in ("dynamic factor", "load detector", "strain", "largest line of the spectrum"):
        assert text in result.stdout


def test_tables_hold_one_part(call, tmp_path):
    path = tmp_path / "bands.parquet"
    assert call("--part", "third_octaves", "--output", path).exit_code == 0
    table = pq.read_table(path)
    assert table.column_names == [
        "band_frequency [Hz]",
        "nominal_frequency [Hz]",
        "contact_force_band[1] [N]",
        "contact_force_band[2] [N]",
    ]
    path = tmp_path / "bays.csv"
    assert call("--part", "bays", "--output", path).exit_code == 0
    heading, *rows = path.read_text(encoding="utf-8").splitlines()
    assert heading.startswith("bay [1],bay_position [m],bay_max_force[1] [N]")
    assert len(rows) == 9
    refused = call("--output", tmp_path / "all.csv")
    assert refused.exit_code == 2
    assert "choose one with --part" in one_sentence(refused)


@pytest.mark.parametrize("suffix", [".nc", ".mat"])
def test_files_of_many_arrays_hold_everything(call, passage, tmp_path, suffix):
    path = tmp_path / f"evaluation{suffix}"
    assert call("--output", path).exit_code == 0
    expected = evaluate(passage)
    if suffix == ".nc":
        with xr.open_dataset(path, engine="h5netcdf") as stored:
            xr.testing.assert_identical(stored.load(), expected)
    else:
        stored = loadmat(path, simplify_cells=True)
        for name, variable in expected.variables.items():
            np.testing.assert_array_equal(stored[name], variable.to_numpy(), err_msg=name)


def test_choices_reach_the_evaluation(call):
    options = ("--rate", "2000", "--resolution", "20", "--bays", "5", "--gauge-depth", "-0.09")
    found = json.loads(call("--json", *options).stdout)
    assert found["bay"] == [24, 25, 26, 27, 28]
    frequency = json.loads(call("--json", *options, "--part", "spectrum").stdout)["frequency"]
    assert frequency == pytest.approx(20.0 * np.arange(1, 41))


def test_a_short_run_has_the_lines_that_it_resolves(make_passage):
    passage = make_passage(np.linspace(-0.3, 0.3, 400))  # 54 ms
    frequency = evaluate(passage, part=PartName.SPECTRUM)["frequency"].to_numpy()
    assert frequency[0] == pytest.approx(6000.0 / 325.0)  # one segment of all samples


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--rate", "10"), "evaluation.rate is 10 Hz but must be at least 100 Hz"),
        (("--resolution", "1e9"), "1e+09 Hz apart but it ends at 2.4e+03 Hz"),
        (("--resolution", "0.001"), "ask for a coarser resolution"),
        (("--bay-share", "1.5"), "evaluation.bay_share is 1.5 but must be at most 1"),
        (("--plot", "x.doc"), "must end with one of .png, .pdf, .svg"),
    ],
)
def test_wrong_choices_are_refused(call, options, message):
    result = call(*options)
    assert result.exit_code == 2
    assert message in one_sentence(result)


def test_a_file_that_is_no_result_is_refused(call, tmp_path):
    missing = call(result=tmp_path / "none.nc")
    assert missing.exit_code == 2
    assert "there is no file" in one_sentence(missing)
    text = tmp_path / "text.nc"
    text.write_text("no data")
    wrong = call(result=text)
    assert wrong.exit_code == 2
    assert "cannot be read as a NetCDF file" in one_sentence(wrong)


def test_a_doubtful_run_is_said_to_be_one(call, make_passage, tmp_path):
    path = tmp_path / "broken.nc"
    times = np.linspace(-1.0, 1.0, 2001)
    write_dataset(make_passage(times, complete=False, unreliable="it diverged"), path)
    result = call("--json", result=path)
    assert result.exit_code == 0
    early, wrong = result.stderr.splitlines()
    assert "ended early" in early
    assert wrong.endswith("the run is wrong: it diverged")


def test_a_picture_is_written(call, tmp_path):
    assert call("--part", "detector", "--plot", tmp_path / "x.pdf").exit_code == 0
    assert (tmp_path / "x.pdf").read_bytes().startswith(b"%PDF")


def test_what_the_user_chooses_has_limits():
    with pytest.raises(InputError, match=r"evaluation\.bays is 0 bays but must be at least 1 bays"):
        Evaluation(bays=0)
