"""`railcosim irregularity` and what it shows."""

import json
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure
from typer.testing import CliRunner

from railcosim import cli
from railcosim.figures.irregularity import draw_surfaces
from railcosim.irregularity.bands import band_levels
from railcosim.scenario_file import read_scenario
from railcosim.surfaces.report import surface_numbers, surface_report
from railcosim.surfaces.tables import compose

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


def irregularity(*arguments):
    return CliRunner().invoke(cli.app, ["irregularity", *map(str, arguments)])


def test_tables_arrays_picture_and_numbers_are_of_one_surface(tmp_path):
    files = tmp_path / "surface.nc", tmp_path / "surface.png"
    answer = irregularity(
        EXAMPLES / "worn_wheels.toml", "--json", "--tables", tmp_path, "--output", files[0],
        "--plot", files[1],
    )  # fmt: skip
    assert answer.exit_code == 0, answer.stderr
    numbers = json.loads(answer.stdout)
    assert numbers["rail"] is None
    assert not (tmp_path / "rail.csv").exists()
    table = np.loadtxt(tmp_path / "wheel2.csv", delimiter=",", skiprows=1)
    with xr.open_dataset(files[0]) as data:
        assert data["tread_drop"][1].to_numpy().tobytes() == table[:, 1].tobytes()
    assert numbers["wheels"]["2"]["largest"] == table[:, 1].max() == pytest.approx(0.4e-3)
    # two orders: 1 um * 10^(25 / 20), and 1e-4 m / sqrt(2)
    rms = np.hypot(1e-6 * 10**1.25, 1e-4 / np.sqrt(2))
    assert numbers["wheels"]["1"]["rms"] == pytest.approx(rms, rel=1e-9)
    assert files[1].stat().st_size > 1e4


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ((), "rail and wheels of this scenario are smooth"),
        ((EXAMPLES / "worn_wheels.toml", "--tables", "/nowhere"), "is no folder"),
        ((EXAMPLES / "worn_wheels.toml", "--output", "x.csv"), "must end with one of .nc"),
    ],
)
def test_what_cannot_be_shown_is_refused(arguments, sentence):
    answer = irregularity(*arguments)
    assert answer.exit_code == 2
    assert sentence in answer.stderr


def test_a_rail_has_a_table_and_two_panels():
    case = read_scenario(EXAMPLES / "uneven_rail.toml")
    surfaces = compose(case)
    table = surface_report(surface_numbers(case, surfaces))
    assert table.row_count == 1
    figure = draw_surfaces(case, surfaces)
    assert isinstance(figure, Figure)
    wavelengths, levels = figure.axes[1].lines[0].get_data()
    # 10 dB above 4.9 dB at 10 cm, from some 50 independent lines, less 0.1 dB of the patch
    assert levels[np.argmin(abs(wavelengths - 10.0))] == pytest.approx(14.9, abs=1.0)


def test_a_sine_has_its_level_in_its_band_alone():
    x = 1e-3 * np.arange(8000)
    wavelength, level = band_levels(3e-6 * np.sin(2 * np.pi * x / 0.1), 1e-3)
    peak = int(np.argmax(level))
    assert wavelength[peak] == pytest.approx(0.1, rel=1e-12)
    # the r.m.s. of a sine; the window's side lobes are 32 dB down next to it
    assert level[peak] == pytest.approx(20 * np.log10(3 / np.sqrt(2)), abs=0.01)
    assert (np.delete(level, peak) < level[peak] - 60.0).all()
