"""Replay files: a failure repeats itself from what was written about it."""

import json
import zipfile

import pytest

from orchestrator import (
    Connection,
    FmuSource,
    InputError,
    Linear,
    Master,
    MasterSettings,
    Recorder,
    RunError,
    StopReason,
    System,
    SystemFileError,
)
from orchestrator.errors import without_log
from orchestrator.replay import ReplayCase, open_replay, repeat, write_replay

fixed = {"tolerance": None, "fixed_step": 0.01}

wires = (
    Connection(source="one.x", target="two.force"),
    Connection(source="two.x", target="one.force", conversion=Linear(-1.0, 0.0)),
)


def failing_run(fmu, path, *, timeout=None, one=None, two=None, events=(), **settings):
    """Run two masses that push each other until one fails, and write the replay file."""
    sources = tuple(
        FmuSource(path=fmu, name=name, start_values=values or {}, timeout=timeout)
        for name, values in (("one", one), ("two", two))
    )
    chosen = MasterSettings(**settings)
    recorder = Recorder()
    system = System([source.open() for source in sources], wires)
    master = Master(system, chosen, events=events, observers=[recorder])
    with pytest.raises(RunError) as caught:
        master.run(0.0, 1.0)
    error = caught.value
    case = ReplayCase(
        name="two masses",
        sources=sources,
        connections=wires,
        settings=chosen,
        events=events,
        observed=tuple(recorder.variables),
        start_time=0.0,
        stop_time=1.0,
        error=str(error),
        attempt=error.last_attempt,
    )
    write_replay(path, case)
    return error, recorder


def repeated(path):
    with open_replay(path) as case:
        return repeat(case)


@pytest.mark.parametrize(
    ("two", "settings", "part"),
    [
        ({"trouble": 9}, {**fixed, "min_step": 1e-3}, "two: its value of x is not finite"),
        ({"trouble": 1}, {**fixed, "fixed_step": 0.02}, "two: the step ended with fmi2Discard"),
        (
            {"trouble": 9},
            {"tolerance": 1e-3, "max_step": 0.05, "min_step": 1e-3},
            "two: its value of x is not finite",
        ),
        (
            {"mass": 0.5},
            {"tolerance": 1e-7, "max_step": 0.1, "min_step": 0.05, "initial_step": 0.05},
            "the predicted and the computed value of",
        ),
    ],
    ids=["not a number", "discard", "error control", "error"],
)
def test_the_last_attempt_repeats_itself_from_its_states(fmu, tmp_path, two, settings, part):
    error, recorder = failing_run(fmu, tmp_path / "r.replay", two=two, **settings)
    assert part in str(error)
    assert error.outcome.reason is StopReason.FAILED
    assert error.outcome.failure == str(error)
    assert error.outcome.end_time == recorder.time[-1] == error.last_attempt.time
    repetition = repeated(tmp_path / "r.replay")
    assert repetition.reproduced
    assert not repetition.from_start
    assert without_log(repetition.message) in str(error)
    last = repetition.rows[-1]
    assert (last.time, last.participant) == (error.last_attempt.time, "two")
    assert list(last.inputs) == ["force"]
    assert [row.iteration for row in repetition.rows if row.participant == "one"] == [
        *range(1, 1 + sum(row.participant == "one" for row in repetition.rows))
    ]


@pytest.mark.parametrize(
    ("two", "settings"),
    [
        ({"trouble": 2}, fixed),
        ({"trouble": 9}, {**fixed, "algorithm": "gauss_seidel"}),
        ({"trouble": 3}, fixed),
        ({"trouble": 4}, fixed),
    ],
    ids=["fatal", "no states saved", "initialisation", "false claim"],
)
def test_where_states_are_out_of_reach_the_whole_run_is_repeated(fmu, tmp_path, two, settings):
    error, _ = failing_run(fmu, tmp_path / "r.replay", two=two, **settings)
    assert error.last_attempt is None
    repetition = repeated(tmp_path / "r.replay")
    assert repetition.reproduced
    assert repetition.from_start
    assert repetition.message.startswith(str(error)[:20])


def test_a_crash_repeats_itself_from_the_last_states(fmu, tmp_path):
    error, _ = failing_run(fmu, tmp_path / "r.replay", two={"trouble": 6}, timeout=60.0, **fixed)
    assert "two: its process was ended by SIGSEGV" in str(error)
    repetition = repeated(tmp_path / "r.replay")
    assert repetition.reproduced
    assert not repetition.from_start
    assert "SIGSEGV" in repetition.rows[-1].status
    assert repetition.rows[-1].outputs == {}


def test_a_file_is_complete_and_leaves_nothing(fmu, tmp_path, unpacked):
    failing_run(fmu, tmp_path / "r.replay", two={"trouble": 9}, min_step=1e-3, **fixed)
    with zipfile.ZipFile(tmp_path / "r.replay") as archive:
        names = [name.partition("/")[0] for name in archive.namelist()]
    assert names == ["replay.json", "fmus", "states", "states"]  # the same FMU once
    with open_replay(tmp_path / "r.replay") as case:
        assert [source.name for source in case.sources] == ["one", "two"]
        assert case.connections == wires
        assert case.sources[1].start_values == {"trouble": 9}
    assert [*unpacked.iterdir()] == []


def test_what_did_not_fail_again_is_not_called_reproduced(fmu, tmp_path):
    fuse = tmp_path / "fuse"
    two = {"trouble": 9, "label": str(fuse)}
    failing_run(fmu, tmp_path / "r.replay", two=two, algorithm="gauss_seidel", **fixed)
    repetition = repeated(tmp_path / "r.replay")
    assert (repetition.reproduced, repetition.message) == (False, "")


@pytest.mark.parametrize(
    ("where", "key", "value", "message"),
    [
        ("attempt", "values", [0.0], "1 exchanged values and 0 indicators, the system 2 and 0"),
        ("attempt", "slope", [0.0], "it belongs to another one"),
        ("attempt", "indicators", [0.0], "2 exchanged values and 1 indicators"),
        (None, "events", [3], "is not of the form"),
        (None, "stop_time", "soon", "no replay file"),
    ],
)
def test_forged_files_are_refused_in_a_sentence(fmu, tmp_path, where, key, value, message):
    path = tmp_path / "r.replay"
    failing_run(fmu, path, two={"trouble": 9}, min_step=1e-3, **fixed)
    with zipfile.ZipFile(path) as archive:
        contents = {name: archive.read(name) for name in archive.namelist()}
    document = json.loads(contents["replay.json"])
    (document if where is None else document[where])[key] = value
    contents["replay.json"] = json.dumps(document)
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in contents.items():
            archive.writestr(name, content)
    with pytest.raises(InputError, match=message):
        repeated(path)


def test_other_files_are_refused(tmp_path):
    path = tmp_path / "x.replay"
    with pytest.raises(SystemFileError, match="no such file"), open_replay(path):
        pass
    path.write_text("nothing")
    with pytest.raises(SystemFileError, match="cannot be unpacked"), open_replay(path):
        pass
    for text in ("[]", "{}", '{"format": "other"}'):
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("replay.json", text)
        with pytest.raises(SystemFileError, match="no replay file"), open_replay(path):
            pass
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("../replay.json", "{}")
    with pytest.raises(SystemFileError, match="not unpacked"), open_replay(path):
        pass
