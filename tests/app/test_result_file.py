"""Reading results back: nothing but the whole result of a passage passes for one."""

import numpy as np
import pytest

from railcosim.errors import InputError
from railcosim.output import write_dataset
from railcosim.passage_check import check_passage
from railcosim.result_file import read_netcdf, read_passage


@pytest.fixture
def passage(make_passage):
    return make_passage(np.linspace(-1.0, 1.0, 50))


def without(name):
    return lambda passage: passage.drop_vars(name)


def with_attribute(**attributes):
    return lambda passage: passage.assign_attrs(attributes)


def with_hole(passage):
    passage["contact_force"][3, 1] = np.nan
    return passage


def with_texts(passage):
    return passage.assign(contact_force=passage["contact_force"].astype(str))


DAMAGES = {
    "it has no contact_force": without("contact_force"),
    "it has no distance": without("distance"),
    "it has no flat_wheel": without("flat_wheel"),
    "it has no attempt_cause": without("attempt_cause"),
    "it has no time": lambda passage: passage.rename(time="t"),
    "its contact is 'both'": with_attribute(contact="both"),
    "its wall_time is 'long'": with_attribute(wall_time="long"),
    "its scenario is 5": with_attribute(scenario=5),
    "its scenario cannot be read: foo is no section": with_attribute(scenario="foo = 1"),
    "its scenario cannot be read: the scenario is not valid": with_attribute(scenario="foo ="),
    "its contact_force has values that are not finite": with_hole,
    "its contact_force has values of the type": with_texts,
    "its contact_force has the dimensions time": lambda p: p.assign(contact_force=p["distance"]),
    "it has 1 of the 2 wheels of its scenario": lambda p: p.isel(wheel=[0]),
    "it has no accepted time": lambda p: p.isel(time=slice(0)),
    "its times do not increase": lambda p: p.isel(time=slice(None, None, -1)),
}


@pytest.mark.parametrize("complaint", DAMAGES)
def test_what_is_not_the_whole_result_of_a_passage_is_refused(complaint, passage):
    damaged = DAMAGES[complaint](passage)
    with pytest.raises(InputError) as refused:
        check_passage(damaged, "r.nc")
    assert str(refused.value).startswith(f"r.nc is not the result of a passage ({complaint}")


@pytest.mark.parametrize("key", ["complete", "iterations", "steps_rejected_event", "unreliable"])
def test_a_missing_attribute_is_named(key, passage):
    del passage.attrs[key]
    with pytest.raises(InputError, match=rf"\(it has no {key}\)"):
        check_passage(passage, "r.nc")


def test_a_result_written_is_one_read(passage, tmp_path):
    path = tmp_path / "r.nc"
    write_dataset(passage, path)
    assert read_passage(path).equals(read_netcdf(path, "never"))
    write_dataset(passage.isel(time=slice(1)), path)  # a run that failed in its first step
    assert read_passage(path).sizes["time"] == 1


@pytest.mark.parametrize(
    ("name", "content", "complaint"),
    [
        ("none.nc", None, "there is no file"),
        ("n" * 300, None, "is no usable name"),
        ("empty.nc", 0, "cannot be read as a NetCDF file"),
        ("head.nc", 20_000, "cannot be read as a NetCDF file"),
        ("most.nc", -1, "cannot be read as a NetCDF file"),
    ],
)
def test_a_file_that_is_none_is_refused_in_a_line(name, content, complaint, passage, tmp_path):
    path = tmp_path / name
    if content is not None:
        write_dataset(passage, path)
        path.write_bytes(path.read_bytes()[:content])
    with pytest.raises(InputError, match=complaint) as refused:
        read_netcdf(path, "give another")
    assert "\n" not in str(refused.value)


def test_a_folder_is_no_file(tmp_path):
    with pytest.raises(InputError, match="is a folder"):
        read_netcdf(tmp_path, "give another")
