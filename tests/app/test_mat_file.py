import numpy as np
import pytest
import xarray as xr
from scipy.io import loadmat, whosmat

from railcosim import mat_file
from railcosim.errors import RunError
from railcosim.mat_file import write_mat
from railcosim.output import write_dataset

FORCE = np.array([1.0, 1.0 / 3.0, 2e5, 117720.0])


@pytest.fixture
def passage(make_passage):
    return make_passage([-0.2, 0.0, 0.1, 0.9], series={"contact_force": {1: FORCE}})


def read(path):
    return loadmat(path, simplify_cells=True)


def test_matlab_gets_everything_bit_for_bit(passage, tmp_path):
    path = tmp_path / "passage.mat"
    write_dataset(passage, path)
    stored = read(path)
    assert {name for name in stored if not name.startswith("__")} == {*passage.variables, "about"}
    for name, variable in passage.variables.items():
        np.testing.assert_array_equal(stored[name], variable.to_numpy(), err_msg=name)
    assert [*tmp_path.iterdir()] == [path]


def test_series_are_columns_and_truths_logical(passage, tmp_path):
    write_dataset(passage, tmp_path / "passage.mat")
    stored = {name: (shape, kind) for name, shape, kind in whosmat(tmp_path / "passage.mat")}
    assert stored["time"] == ((4, 1), "double")
    assert stored["contact_force"] == ((4, 2), "double")
    assert stored["in_contact"] == ((4, 2), "logical")
    assert stored["attempt_cause"] == ((2, 1), "cell")


def test_the_file_says_what_everything_means(passage, tmp_path):
    write_dataset(passage, tmp_path / "passage.mat")
    about = read(tmp_path / "passage.mat")["about"]
    assert about["variables"]["contact_force"] == {
        "units": "N",
        "long_name": "wheel-rail contact force",
        "sign": "positive in compression",
        "dimensions": "time, wheel",
    }
    assert about["attributes"]["scenario"] == passage.attrs["scenario"]
    assert about["attributes"]["steps_accepted"] == 3


def test_names_that_matlab_does_not_take_are_changed_and_told(tmp_path):
    values = {"track.wheel[1].x": 1.0, "track_wheel_1_x": 2.0, "1st": 3.0, "about": 4.0}
    long = {"a" * 70: 5.0, "a" * 71: 6.0}
    write_mat(xr.Dataset(values | long), tmp_path / "x.mat")
    stored = read(tmp_path / "x.mat")
    names = ["track_wheel_1_x", "track_wheel_1_x_2", "v_1st", "about_2", "a" * 63, "a" * 61 + "_2"]
    assert [stored[name] for name in names] == [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]
    originals = stored["about"]["variables"]
    assert [originals[name].get("original_name") for name in names[:3]] == [
        "track.wheel[1].x",
        "track_wheel_1_x",
        "1st",
    ]


def test_an_array_too_large_for_the_format_is_refused(passage, tmp_path, monkeypatch):
    monkeypatch.setattr(mat_file, "LARGEST", 40)
    with pytest.raises(RunError, match=r"has .* GB but an array in a MAT file at most"):
        write_dataset(passage, tmp_path / "passage.mat")
    assert [*tmp_path.iterdir()] == []
