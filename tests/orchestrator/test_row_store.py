"""Tables of bounded memory: the same rows wherever they are, and nothing left behind."""

import gc
import resource
import tempfile
import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from fake_participants import Answering

from orchestrator import LastPoint, Master, MasterSettings, Recorder, RunError, System, row_store
from orchestrator.row_store import RowStore

row_type = np.dtype([("n", np.int64), ("x", np.float64, (3,))])


def rows(start, stop):
    table = np.empty(stop - start, row_type)
    table["n"] = np.arange(start, stop)
    table["x"] = table["n"][:, None] / [1.0, 3.0, 7.0]
    return table


def open_files():
    return len([*Path("/proc/self/fd").iterdir()])


@pytest.mark.parametrize("limit", [0, 1000, 10**6], ids=["file", "file in the end", "memory"])
def test_rows_come_back_in_order(limit):
    store = RowStore(row_type, limit=limit)
    assert store.as_array().tolist() == []
    for start in range(0, 100, 10):
        buffer = rows(start, start + 10)
        store.extend(buffer)
        buffer["n"] = -1  # the store has its own copy
        assert len(store) == start + 10
        assert store.as_array().tobytes() == rows(0, start + 10).tobytes()


def test_the_file_has_no_name_and_goes_with_the_store(tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    before = open_files()
    store = RowStore(row_type, limit=0)
    store.extend(rows(0, 10))
    assert open_files() == before + 1
    assert [*tmp_path.iterdir()] == []
    table = store.as_array()
    del store
    gc.collect()
    assert table.tobytes() == rows(0, 10).tobytes()
    del table
    assert open_files() == before


@pytest.fixture
def small_disk():
    """Let no file grow beyond 1000 bytes; Python ignores the signal that comes with it."""
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, limits[1]))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, limits)


@pytest.mark.usefixtures("small_disk")
def test_a_full_disk_is_named_and_what_was_kept_is_still_there():
    store = RowStore(row_type, limit=0)
    store.extend(rows(0, 20))
    with pytest.raises(RunError, match=r"20 rows of 32 bytes so far, have no more room .*TMPDIR"):
        store.extend(rows(20, 40))
    assert store.as_array().tobytes() == rows(0, 20).tobytes()


@pytest.mark.usefixtures("small_disk")
def test_rows_in_memory_survive_a_disk_that_takes_none():
    store = RowStore(row_type, limit=2000)
    store.extend(rows(0, 60))
    with pytest.raises(RunError, match="60 rows of 32 bytes so far"):
        store.extend(rows(60, 80))
    assert store.as_array().tobytes() == rows(0, 60).tobytes()


def test_a_recorder_on_disk_is_the_same_bit_for_bit(monkeypatch):
    settings = MasterSettings(tolerance=None, fixed_step=1e-3)
    recorders = []
    for limit in (10**7, 10**4):
        monkeypatch.setattr(row_store, "memory_limit", limit)
        recorder = Recorder()
        system = System([Answering("clock", lambda t, h: t + h)], [])
        Master(system, settings, observers=[recorder]).run(0.0, 3.0)
        recorders.append(recorder)
    inside, outside = recorders
    assert isinstance(outside.time.base, np.memmap)
    assert inside.time.tobytes() == outside.time.tobytes()
    assert inside["clock.y"].tobytes() == outside["clock.y"].tobytes()
    assert outside.values.shape == (3001, 1)


def test_the_last_point_is_that_of_a_recorder():
    settings = MasterSettings(tolerance=None, fixed_step=1e-3)
    everything, last = Recorder(), LastPoint()
    system = System([Answering("clock", lambda t, h: t + h)], [])
    Master(system, settings, observers=[everything, last]).run(0.0, 3.0)
    assert last.time.tolist() == [3.0] == everything.time[-1:].tolist()
    assert last.values.tobytes() == everything.values[-1:].tobytes()
    assert last["clock.y"].tolist() == [3.0]


def test_memory_is_flat_over_many_steps(monkeypatch):
    monkeypatch.setattr(row_store, "memory_limit", 10**5)
    steps, marks = 40_000, []

    class Watching(Recorder):
        points = 0

        def accepted(self, time, values):
            super().accepted(time, values)
            self.points += 1
            if self.points in {steps // 2, steps}:
                marks.append(tracemalloc.get_traced_memory()[0])

    settings = MasterSettings(tolerance=None, fixed_step=1e-3)
    system = System([Answering("clock", lambda t, h: t + h)], [])
    recorder = Watching()
    tracemalloc.start()
    try:
        outcome = Master(system, settings, observers=[recorder]).run(0.0, 1e-3 * steps)
    finally:
        tracemalloc.stop()
    assert outcome.statistics.accepted == len(outcome.step_log) == steps
    # Kept in memory, 2e4 rows of 16 and of 37 bytes would be 1e6; a chunk is at most 1e5.
    assert abs(marks[1] - marks[0]) < 2e5
