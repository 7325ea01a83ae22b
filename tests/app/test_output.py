import csv
import errno
import resource

import numpy as np
import pyarrow.parquet as pq
import pytest
import xarray as xr

from railcosim.errors import InputError, RunError
from railcosim.figures.passage import draw_passage
from railcosim.output import (
    DATA_SUFFIXES,
    FIGURE_SUFFIXES,
    check_writable,
    write_dataset,
    write_figure,
)
from railcosim.scenario import Scenario
from railcosim.scenario_file import from_toml
from railcosim.summary import summarise

FORCE = np.array([1.0, 1.0 / 3.0, 2e5, 117720.0])


@pytest.fixture
def passage(make_passage):
    return make_passage([-0.2, 0.0, 0.1, 0.9], series={"contact_force": {1: FORCE}})


def check(path, suffixes=DATA_SUFFIXES):
    check_writable(path, option="--output", suffixes=suffixes)


def test_every_variable_says_unit_name_and_sign(passage):
    for name, variable in passage.variables.items():
        assert {"units", "long_name", "sign"} <= set(variable.attrs), name
        assert all(variable.attrs.values()), name


def test_netcdf_gives_back_everything(passage, tmp_path):
    path = tmp_path / "passage.nc"
    write_dataset(passage, path)
    with xr.open_dataset(path, engine="h5netcdf") as stored:
        xr.testing.assert_identical(stored.load(), passage)
        assert from_toml(stored.attrs["scenario"]).flat.position == 16.6
        assert summarise(stored) == summarise(passage)
        assert stored["in_contact"].dtype == bool
    assert [*tmp_path.iterdir()] == [path]


def test_csv_gives_back_the_series_bit_for_bit(passage, tmp_path):
    path = tmp_path / "passage.csv"
    write_dataset(passage, path)
    with path.open(encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    table = dict(zip(header, zip(*rows, strict=True), strict=True))
    assert header[:3] == ["time [s]", "distance [m]", "contact_force[1] [N]"]
    assert [float(cell) for cell in table["contact_force[1] [N]"]] == FORCE.tolist()
    assert table["in_contact[2] [1]"] == ("1", "1", "1", "1")
    wheels, sleepers, gauges = 2, 49, 3
    assert len(header) == 2 + 9 * wheels + 3 * sleepers + gauges


def test_parquet_gives_back_the_series_with_their_meaning(passage, tmp_path):
    path = tmp_path / "passage.parquet"
    write_dataset(passage, path)
    table = pq.read_table(path)
    assert table["contact_force[1] [N]"].to_pylist() == FORCE.tolist()
    assert table.schema.field("contact_force[1] [N]").metadata[b"units"] == b"N"
    assert from_toml(table.schema.metadata[b"scenario"].decode()) == from_toml(
        passage.attrs["scenario"]
    )


@pytest.mark.parametrize("suffix", FIGURE_SUFFIXES)
def test_figures_are_written_in_their_format(passage, tmp_path, suffix):
    path = tmp_path / f"passage{suffix}"
    check(path, FIGURE_SUFFIXES)
    write_figure(draw_passage(passage), path)
    starts = {".png": b"\x89PNG", ".pdf": b"%PDF", ".svg": b"<?xml"}
    assert path.read_bytes().startswith(starts[suffix])


def test_a_writable_place_is_left_as_it_was(tmp_path):
    path = tmp_path / "passage.nc"
    check(path)
    assert [*tmp_path.iterdir()] == []
    path.write_text("before")
    check(path)
    assert path.read_text() == "before"


def test_places_that_cannot_be_written_are_refused_before_the_run(tmp_path):
    for path, part in (
        (tmp_path / "passage.txt", "must end with one of .nc, .csv, .parquet, .mat"),
        (tmp_path / "missing" / "passage.nc", "folder that does not exist"),
        (tmp_path, "must end with"),
    ):
        with pytest.raises(InputError, match=part):
            check(path)
    folder = tmp_path / "folder.nc"
    folder.mkdir()
    with pytest.raises(InputError, match="is a folder"):
        check(folder)


def test_a_folder_that_takes_no_files_is_refused(tmp_path, monkeypatch):
    def refuse(**_):
        raise PermissionError(errno.EACCES, "Permission denied")

    monkeypatch.setattr("railcosim.output.tempfile.TemporaryDirectory", refuse)
    with pytest.raises(InputError, match="is not writable: choose another place"):
        check(tmp_path / "passage.nc")


def test_a_missing_parquet_library_is_named(tmp_path, monkeypatch):
    monkeypatch.setattr("railcosim.output.importlib.util.find_spec", lambda _: None)
    with pytest.raises(InputError, match=r"pip install 'railcosim\[parquet\]'"):
        check(tmp_path / "passage.parquet")


def test_a_failed_write_leaves_the_old_file_and_nothing_else(passage, tmp_path, monkeypatch):
    path = tmp_path / "passage.csv"
    path.write_text("before")

    def fill_disk(_passage, temporary, **_):
        temporary.write_text("half")
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("railcosim.output._write_csv", fill_disk)
    with pytest.raises(RunError, match="No space left on device"):
        write_dataset(passage, path)
    assert path.read_text() == "before"
    assert [*tmp_path.iterdir()] == [path]


def test_positions_along_the_rail_are_in_the_result(passage):
    assert passage["sleeper_position"].sel(sleeper=1) == Scenario().track.sleeper_spacing
    assert passage["gauge_position"].to_numpy() == pytest.approx(Scenario().gauge_positions)
    assert passage["distance"].to_numpy() == pytest.approx([-0.2, 0.0, 0.1, 0.9], abs=1e-12)


def test_a_slash_in_a_name_does_not_stop_netcdf(passage, tmp_path):
    path = tmp_path / "slash.nc"
    write_dataset(passage.rename({"contact_force": "a.force/x"}), path)
    with xr.open_dataset(path, engine="h5netcdf") as stored:
        assert "a.force|x" in stored


def test_a_full_disk_ends_in_one_sentence_and_keeps_the_old_file(passage, tmp_path):
    path = tmp_path / "passage.nc"
    path.write_text("before")
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (10**5, limits[1]))
    try:
        with pytest.raises(RunError, match=r"passage\.nc cannot be written: File too large"):
            write_dataset(passage, path)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert path.read_text() == "before"
    assert [*tmp_path.iterdir()] == [path]


def test_no_room_stays_reserved(passage, tmp_path):
    path = tmp_path / "passage.nc"
    write_dataset(passage, path)
    assert path.stat().st_size < 10**6
    assert path.stat().st_blocks * 512 < 10**6


def test_long_tables_are_written_in_parts(make_passage, tmp_path):
    distance = np.linspace(-1.0, 1.0, 10_001)
    path = tmp_path / "passage.csv"
    write_dataset(make_passage(distance), path)
    with path.open(encoding="utf-8", newline="") as file:
        _, *rows = csv.reader(file)
    assert len(rows) == distance.size
    assert [float(row[1]) for row in rows] == pytest.approx(distance, abs=1e-12)
