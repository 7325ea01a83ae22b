"""Calls by the book and against it: the standard's status, a sentence in the log, no crash."""

import ctypes
import shutil
from ctypes import c_double, c_int, c_size_t

import pytest

from .fmi_calls import DISCARD, ERROR, OK, references

both_versions = pytest.mark.parametrize("version", [2, 3])
both = pytest.mark.parametrize("model", ["track", "vehicle", "track_contact", "masses"])


@both_versions
@both
def test_a_life_in_order(fmi, version, model):
    instance = fmi(version, model).start(time=1.0)
    assert instance.step(1.0, 1e-4) == (OK, 1.0001)
    assert instance.call("Terminate") == OK
    assert instance.messages == []


@both_versions
@both
def test_calls_in_the_wrong_phase(fmi, version, model):
    instance = fmi(version, model)
    assert instance.step(0.0, 1e-4)[0] == ERROR
    assert instance.message.endswith("DoStep may not be called before the initialisation")
    assert instance.call("ExitInitializationMode") == ERROR
    assert instance.call("Terminate") == ERROR
    instance.start()
    assert instance.call("ExitInitializationMode") == ERROR
    assert instance.message.endswith("between steps")
    assert instance.setup(0.0) == ERROR
    assert instance.call("Terminate") == OK
    assert instance.step(0.0, 1e-4)[0] == ERROR
    assert instance.message.endswith("DoStep may not be called after the end")
    assert instance.call("Reset") == OK
    assert instance.start().step(0.0, 1e-4) == (OK, 1e-4)


@both_versions
def test_experiments_that_cannot_be(fmi, version):
    instance = fmi(version, "vehicle")
    assert instance.setup(1.0, stop=0.5) == ERROR
    assert instance.message == "the stop time of 0.5 s is before the start time of 1 s"
    assert instance.setup(float("nan")) == ERROR
    assert instance.setup(0.5, stop=0.5) == OK


@both_versions
def test_null_pointers(fmi, version):
    instance = fmi(version, "track").start()
    kind = "Real" if version == 2 else "Float64"
    one = references([0])
    assert instance.call(f"Get{kind}", None, c_size_t(1), None, *instance.n(1)) == ERROR
    assert instance.call(f"Get{kind}", one, c_size_t(1), None, *instance.n(1)) == ERROR
    assert instance.message == f"fmi{version}Get{kind} was called with a NULL pointer"
    assert instance.call(f"Get{kind}", None, c_size_t(0), None, *instance.n(0)) == OK
    for name in ("GetFMUstate", "FreeFMUstate", "SetFMUstate"):
        assert instance.call(name, None) == ERROR
    instance.handle, handle = None, instance.handle
    assert instance.call("Reset") == ERROR
    instance.handle = handle


@both_versions
def test_unknown_and_wrong_variables(fmi, version):
    instance = fmi(version, "track")
    instance.number |= {"nothing": 100_000}
    assert instance.put("nothing", 1.0) == ERROR
    assert instance.message.startswith("there is no variable 100000; the last one is ")
    assert instance.put("wheel[2].position", True) == ERROR
    assert instance.message == "wheel[2].position is a Real, not a Boolean"
    assert instance.put("wheel[2].rail_velocity", 1.0) == ERROR
    assert instance.message == "wheel[2].rail_velocity is an output and cannot be set"
    assert instance.put("pad_stiffness", 1e8) == ERROR
    assert instance.message.startswith("pad_stiffness is fixed in this FMU")
    instance.start()
    assert instance.put("ballast", "linear") == ERROR
    assert instance.message.startswith("ballast is fixed once the initialisation has ended")


def test_counts_that_do_not_match(fmi):
    instance = fmi(3, "track").start()
    values = (c_double * 2)()
    numbers = references([19, 20])
    assert instance.call("GetFloat64", numbers, c_size_t(2), values, c_size_t(1)) == ERROR
    assert instance.message == "fmi3GetFloat64 was called with 1 values in place of 2"


@pytest.mark.parametrize("model", ["track", "vehicle", "track_contact", "masses"])
def test_arrays_of_fmi_3_show_the_scalars_of_all_wheels_and_sleepers(fmi, model):
    instance = fmi(3, model).start()
    instance.must(instance.step(0.0, 1e-4)[0])
    arrays = [v for v in instance.description.modelVariables if v.dimensions]
    assert {v.name for v in arrays} >= {"wheel.position", "wheel.contact_force"}
    for array in arrays:
        head, _, tail = array.name.partition(".")
        size = int(array.dimensions[0].start)
        values = (c_double * (size + 1))()
        number = references([array.valueReference, instance.number["time"]])
        count = c_size_t(size + 1)
        instance.must(instance.call("GetFloat64", number, c_size_t(2), values, count))
        assert list(values)[:-1] == instance.get(*(f"{head}[{k + 1}].{tail}" for k in range(size)))
        assert values[size] == 1e-4
        assert f"{head}[{size + 1}].{tail}" not in instance.number
        assert instance.put(array.name, 1.0) == ERROR


def test_the_host_is_told_of_the_end_of_every_step_in_fmi_3(fmi):
    told = []

    def update(_, time, may_set, may_get, finished, may_leave, *_rest):
        told.append((time, instance.get("wheel[1].contact_force")[0]))
        assert (may_set, may_get, finished, may_leave) == (False, True, True, False)

    instance = fmi(3, "vehicle", update=update).start()
    for k in range(3):
        instance.must(instance.step(k * 1e-4, 1e-4)[0])
        assert told[k] == (pytest.approx((k + 1) * 1e-4), instance.get("wheel[1].contact_force")[0])
    assert instance.step(3e-4, -1.0)[0] == DISCARD
    assert len(told) == 3


@both_versions
@both
def test_discarded_steps_change_nothing(fmi, version, model):
    one, other = (fmi(version, model).start() for _ in range(2))
    lead = {"vehicle": "wheel[1].rail_displacement", "track_contact": "wheel[1].displacement"}.get(
        model, "wheel[1].contact_force"
    )
    names = ["wheel[1].contact_force", "wheel[1].position"]
    for instance in (one, other):
        instance.must(instance.step(0.0, 1e-4)[0])
    before = one.get(lead)[0]
    assert one.put(lead, float("nan")) == OK
    assert one.step(1e-4, 1e-4) == (DISCARD, 1e-4)
    assert one.messages[-1][0] == "logStatusDiscard"
    assert one.put(lead, before) == OK
    assert one.step(2e-4, 1e-4) == (DISCARD, 1e-4)
    assert one.step(1e-4, -1e-4) == (DISCARD, 1e-4)
    for instance in (one, other):
        assert instance.step(1e-4, 1e-4)[0] == OK
    assert one.get(*names) == other.get(*names)


def test_status_of_steps_in_fmi_2(fmi):
    instance = fmi(2, "vehicle").start()
    status, terminated, whole = c_int(-1), c_int(-1), c_int(-1)
    text = ctypes.c_char_p()
    for step, expected in ((1e-4, OK), (-1.0, DISCARD)):
        time = instance.step(0.0 if expected == OK else 1e-4, step)[1]
        assert time == 1e-4
        assert instance.call("GetStatus", c_int(0), ctypes.byref(status)) == OK
        assert status.value == expected
    assert instance.call("GetBooleanStatus", c_int(3), ctypes.byref(terminated)) == OK
    assert terminated.value == 0
    assert instance.call("GetStringStatus", c_int(1), ctypes.byref(text)) == OK
    assert text.value == b""
    assert instance.call("GetIntegerStatus", c_int(0), ctypes.byref(whole)) == DISCARD
    assert instance.call("GetRealStatus", c_int(0), ctypes.byref(c_double())) == DISCARD
    assert instance.call("CancelStep") == ERROR


@both_versions
def test_the_log_by_categories(fmi, version):
    flag = c_int if version == 2 else ctypes.c_bool
    instance = fmi(version, "vehicle", logging=False).start()
    instance.step(0.0, -1.0)
    assert instance.messages == []
    names = (ctypes.c_char_p * 1)(b"logStatusDiscard")
    assert instance.call("SetDebugLogging", flag(1), c_size_t(1), names) == OK
    instance.step(0.0, -1.0)
    assert [category for category, _ in instance.messages] == ["logStatusDiscard"]
    assert instance.call("SetDebugLogging", flag(0), c_size_t(0), None) == OK
    instance.step(0.0, -1.0)
    assert instance.put("speed", 1.0) == ERROR
    assert len(instance.messages) == 1
    unknown = (ctypes.c_char_p * 1)(b"weather")
    assert instance.call("SetDebugLogging", flag(1), c_size_t(1), unknown) == ERROR


def test_percent_and_number_signs_are_escaped_in_messages_of_fmi_2(fmi):
    """They are formats, in which # begins the name of a variable."""
    instance = fmi(2, "vehicle")
    instance.put("speed_table", "%s#r1#.csv")
    instance.must(instance.setup(0.0))
    assert instance.call("EnterInitializationMode") == ERROR
    assert "%%s##r1##.csv" in instance.message


@both_versions
def test_instances_that_cannot_be_made(fmi, unpacked, version, tmp_path):
    wrong = fmi(version, "vehicle", build="another build")
    assert wrong.handle is None
    assert "the model description is of another build;" in wrong.message
    nowhere = fmi(version, "vehicle", resources=tmp_path)
    assert nowhere.handle is None
    assert "build.txt cannot be read; unpack the whole FMU" in nowhere.message
    for name in ("build.txt", "model.bin"):
        shutil.copy(unpacked[version, "vehicle"] / "resources" / name, tmp_path)
    data = bytearray((tmp_path / "model.bin").read_bytes())
    data[-100] ^= 1
    (tmp_path / "model.bin").write_bytes(data)
    damaged = fmi(version, "vehicle", resources=tmp_path)
    assert damaged.handle is None
    assert damaged.messages[-1][0] == "logStatusError"


@both_versions
def test_resources_in_a_folder_with_every_kind_of_letter(fmi, unpacked, version, tmp_path):
    folder = tmp_path / "Gleis 50 % + Übergang #1"
    shutil.copytree(unpacked[version, "vehicle"] / "resources", folder)
    assert fmi(version, "vehicle", resources=folder).handle


def test_only_co_simulation(fmi):
    instance = fmi(3, "vehicle")
    for kind, more in (("ModelExchange", 0), ("ScheduledExecution", 3)):
        make = instance.function(f"Instantiate{kind}", ctypes.c_void_p)
        found = make(b"a", b"b", b"c", False, True, None, instance.callback, *[None] * more)
        assert found is None
        assert instance.messages.pop()[1] == "this FMU is for co-simulation only"
