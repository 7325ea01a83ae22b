import numpy as np
import pytest
import xarray as xr

from railcosim.comparison import compare, read_recording, record
from railcosim.errors import InputError
from railcosim.output import write_dataset

TIMES = np.array([0.0, 0.1, 0.1, 0.3])
FORCE = np.array([1.0, 1.0 / 3.0, 2.0, 3.0])


@pytest.fixture
def passage():
    """Series of every shape, a jump, a truth, a slash in a name, a step log beside."""
    return xr.Dataset(
        {
            "force": (("time", "wheel"), np.stack([FORCE, -FORCE], axis=1), {"units": "N"}),
            "in_contact": ("time", np.array([True, True, False, True]), {"units": "1"}),
            "bogie/force": ("time", 2.0 * FORCE, {"units": "N"}),
            "attempt_step": ("attempt", np.array([0.1, 0.2])),
            "static_load": ((), 5.0),
        },
        coords={"time": ("time", TIMES, {"units": "s"}), "wheel": [1, 2]},
        attrs={"scenario": "speed = 40"},
    )


def write(path, text):
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("suffix", [".nc", ".csv", ".parquet"])
def test_a_result_is_the_same_from_every_kind_of_file(passage, suffix, tmp_path):
    path = tmp_path / f"result{suffix}"
    write_dataset(passage, path)
    recording = read_recording(path)
    assert list(recording.series) == ["force[1]", "force[2]", "in_contact", "bogie/force"]
    # some versions of pandas read texts to the last digit but one
    np.testing.assert_allclose(recording.times, TIMES, rtol=1e-15)
    np.testing.assert_allclose(recording.series["force[2]"].values, -FORCE, rtol=1e-15)
    assert recording.series["force[1]"].unit == "N"
    assert recording.series["in_contact"].held
    assert not recording.series["bogie/force"].held
    compared = compare(path, passage)
    assert compared.agrees
    assert all(signal.measures.nrms < 1e-15 for signal in compared.signals)


def test_attributes_and_single_numbers_are_facts(passage, tmp_path):
    write_dataset(passage, tmp_path / "result.nc")
    assert read_recording(tmp_path / "result.nc").facts == {
        "static_load": "5.0",
        "scenario": "speed = 40",
    }


def test_fmpys_array_is_a_result():
    array = np.array(
        [(0.0, 1.5, True, (1.0, 2.0)), (0.1, 2.5, False, (3.0, 4.0))],
        dtype=[("time", float), ("v", float), ("on", bool), ("y", float, (2,))],
    )
    recording = record(array)
    assert list(recording.series) == ["v", "on", "y[1]", "y[2]"]
    assert recording.series["y[2]"].values.tolist() == [2.0, 4.0]
    assert recording.series["on"].held


@pytest.mark.parametrize(
    "text",
    [
        '"time","wheel[1,2].force","on"\n0,1.5,0\n0.1,2.5,1\n',  # FMI cross-check
        "Time;wheel[1,2].force [N];on;\n0;1.5;0;\n0.1;2.5;1;\n",  # ends with a separator
        "\ufefftime\twheel[1,2].force\ton\n0\t1.5\tFalse\n0.1\t2.5\tTrue\n",
    ],
)
def test_tables_of_other_tools(text, tmp_path):
    recording = read_recording(write(tmp_path / "table.csv", text))
    assert list(recording.series) == ["wheel[1,2].force", "on"]
    assert recording.times.tolist() == [0.0, 0.1]
    assert recording.series["wheel[1,2].force"].values.tolist() == [1.5, 2.5]
    assert recording.series["on"].held


def test_whole_numbers_in_a_table_are_numbers(tmp_path):
    recording = read_recording(write(tmp_path / "t.csv", "time,x\n0,1\n1,2\n2,5\n"))
    assert not recording.series["x"].held


def test_an_empty_cell_is_no_zero(tmp_path):
    path = write(tmp_path / "t.csv", "time,x\n0,1.5\n1,\n2,2.5\n")
    compared = compare(path, path)
    assert not compared.agrees
    assert "1 values that are no finite numbers" in compared.signals[0].reasons[0]


def test_texts_are_left_out_and_told(tmp_path):
    path = write(tmp_path / "t.csv", "time,x,mode\n0,1.5,off\n1,2.5,on\n")
    compared = compare(path, path)
    assert [signal.name for signal in compared.signals] == ["x"]
    assert f"{path}: no numbers in mode" in compared.notes


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("t,x\n0,1\n1,2\n", ["no signals called time", "t, x"]),
        ("time,Time,x\n0,0,1\n1,1,2\n", ["2 signals called time"]),
        ("time,x,x\n0,1,1\n1,2,2\n", ["two signals x"]),
        ("time,x\n0,1\n2,2\n1,3\n", ["goes back", "2 s to 1 s"]),
        ("time,x\n0,1\n,2\n", ["time number 2 is nan"]),
        ("time,x\n0,1\n", ["1 times"]),
        ("time,x\n3,1\n3,2\n", ["two different ones"]),
        ("time,x,y\n0,1\n1,2\n", ["3 columns but has 2"]),
        ("time,x\n", ["cannot be read"]),
        ("", ["cannot be read"]),
    ],
)
def test_a_table_that_cannot_be_used_is_refused(text, words, tmp_path):
    path = write(tmp_path / "t.csv", text)
    with pytest.raises(InputError) as refused:
        read_recording(path)
    for word in (str(path), *words):
        assert word in str(refused.value)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("suffix", [".nc", ".parquet", ".csv"])
def test_a_file_of_something_else_is_refused(suffix, tmp_path):
    path = tmp_path / f"result{suffix}"
    path.write_bytes(bytes(range(128, 256)))
    with pytest.raises(InputError, match="cannot be read"):
        read_recording(path)


def test_a_file_of_an_unknown_kind_or_none_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"must end with one of \.nc, \.csv, \.parquet: "):
        read_recording(tmp_path / "result.mat")
    with pytest.raises(InputError, match="check the path"):
        read_recording(tmp_path / "result.nc")


def test_a_result_of_another_kind_is_refused():
    with pytest.raises(InputError, match="is a list"):
        record([1.0, 2.0])
    with pytest.raises(InputError, match="named columns"):
        record(np.zeros((3, 2)))
    with pytest.raises(InputError, match="dimensions t but needs one called time"):
        record(xr.Dataset({"x": ("t", [1.0, 2.0])}))
