import json
import subprocess
import sys

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

from railcosim.cli import app
from railcosim.output import write_dataset

TIMES = np.linspace(0.0, 1.0, 101)


@pytest.fixture
def call():
    return lambda *words: CliRunner().invoke(app, ["compare", *map(str, words)])


@pytest.fixture
def files(tmp_path):
    """A baseline, and a result in which one of three signals is 1 % larger."""
    force = np.sin(6.0 * TIMES)
    for name, factor in (("old", 1.0), ("new", 1.01)):
        series = {"force[1]": factor * force, "force[2]": force, "gap": 2.0 * force}
        dataset = xr.Dataset(
            {key: ("time", values, {"units": "N"}) for key, values in series.items()},
            coords={"time": ("time", TIMES, {"units": "s"})},
        )
        write_dataset(dataset, tmp_path / f"{name}.nc")
    return tmp_path / "new.nc", tmp_path / "old.nc"


def test_what_agrees_ends_with_0(call, files):
    _, old = files
    ended = call(old, old)
    assert ended.exit_code == 0
    assert f"{old} agrees with {old} in 3 signals" in ended.stdout.replace("\n", " ")


def test_what_differs_ends_with_1_and_says_which(call, files):
    ended = call(*files)
    assert ended.exit_code == 1
    assert ended.stderr.endswith("1 of 3 signals differ (force[1])\n")
    assert "force[1]: outside the tube at" in ended.stdout
    assert ended.stdout.count("[s]") == 2  # brackets are no markup


def test_json_is_one_object_with_every_number(call, files):
    ended = call(*files, "--json")
    assert ended.exit_code == 1
    numbers = json.loads(ended.stdout)
    assert numbers["agrees"] is False
    assert numbers["signals"]["force[1]"]["peak_difference"] == pytest.approx(0.01)
    assert [name for name, item in numbers["signals"].items() if item["agrees"]] == [
        "force[2]",
        "gap",
    ]


def test_tolerances_and_patterns_decide(call, files, tmp_path):
    wide = tmp_path / "wide.toml"
    wide.write_text('[signals."force[1]"]\nvalue = 0.02\n', encoding="utf-8")
    assert call(*files, "--tolerances", wide).exit_code == 0
    assert call(*files, "--signals", "gap", "--signals", "force[2]").exit_code == 0


def test_a_figure_has_what_differs_only(call, files, tmp_path):
    figure, folder = tmp_path / "differs.svg", tmp_path / "figures"
    folder.mkdir()
    assert call(*files, "--plot", figure).exit_code == 1
    text = figure.read_text(encoding="utf-8")
    assert "force[1]" in text
    assert "gap" not in text
    assert call(*files, "--plot", folder).exit_code == 1
    assert [path.name for path in folder.iterdir()] == ["001-force_1.png"]


def test_nothing_is_drawn_of_what_agrees(call, files, tmp_path):
    _, old = files
    assert call(old, old, "--plot", tmp_path / "none.png").exit_code == 0
    assert not (tmp_path / "none.png").exists()


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--tolerances", "none.toml"], "cannot read the tolerances none.toml"),
        (["--plot", "x.txt"], "--plot x.txt ends with '.txt'"),
        (["--signals", "nothing"], "none of the signals"),
    ],
)
def test_wrong_input_ends_with_2(call, files, words, told):
    ended = call(*files, *words)
    assert ended.exit_code == 2
    assert told in ended.stderr


def test_a_missing_result_ends_with_2(call, files, tmp_path):
    ended = call(tmp_path / "none.nc", files[1])
    assert ended.exit_code == 2
    assert "there is no file" in ended.stderr


def test_other_commands_do_not_load_what_comparing_needs():
    code = "import sys, railcosim.cli; print('railcosim.comparison' in sys.modules)"
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ended.stdout.strip() == "False"
