"""A million macro steps: memory stays flat, and every time is exact."""

import tracemalloc
from contextlib import nullcontext
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from fake_participants import Answering

from orchestrator import OK, Master, MasterSettings, Recorder, System, row_store
from orchestrator.ssp import AssembledSystem, MasterChoices, SystemDescription
from railcosim import cosim
from railcosim.cosim_options import CosimOptions
from railcosim.cosim_result import label_result
from railcosim.output import write_dataset

megabyte = 2**20


class Fast(Answering):
    """Counts its steps, with states that cost nothing."""

    inputs = ()

    def __init__(self, name):
        super().__init__(name, None)

    def step(self, time, step_size):
        self.time = time + step_size
        self.state += 1.0
        self.result[0] = self.state
        return OK

    def save(self):
        return (self.state, self.time)

    def restore(self, state):
        self.state, self.time = state

    def release(self, state):
        del state


def private_memory():
    """Return the memory of this process that no file stands for [bytes]."""
    status = Path("/proc/self/status").read_text(encoding="ascii")
    (line,) = [line for line in status.splitlines() if line.startswith("RssAnon")]
    return 1024 * int(line.split()[1])


class Weighed(Recorder):
    """Weighs the process from time to time."""

    def __init__(self, every):
        super().__init__()
        self.every, self.points, self.weights = every, 0, []

    def accepted(self, time, values):
        super().accepted(time, values)
        self.points += 1
        if self.points % self.every == 0:
            self.weights.append(private_memory())


def long_run(steps, size, start):
    recorder = Weighed(steps // 10)
    settings = MasterSettings(tolerance=None, fixed_step=size)
    stop = start + steps * size
    system = System([Fast("one"), Fast("two")], [])
    return recorder, Master(system, settings, observers=[recorder]).run(start, stop)


def check(recorder, outcome, steps, size, start):
    """Every grid time is the rounded sum of the start and the rounded product: two roundings."""
    assert outcome.statistics.accepted == steps
    assert outcome.end_time == start + steps * size
    exact = start + np.arange(steps + 1) * size
    assert recorder.time.tobytes() == exact.tobytes()
    assert outcome.step_log["time"].tobytes() == exact[:-1].tobytes()
    assert (outcome.step_log["step_size"] == size).all()
    assert recorder["two.y"].tobytes() == np.arange(steps + 1.0).tobytes()


@pytest.mark.parametrize("start", [0.0, 0.3])
def test_every_time_on_the_grid_is_exact(start, monkeypatch):
    monkeypatch.setattr(row_store, "memory_limit", 10**5)
    recorder, outcome = long_run(20_000, 0.1, start)
    check(recorder, outcome, 20_000, 0.1, start)


def test_a_result_is_written_variable_by_variable(monkeypatch, tmp_path):
    monkeypatch.setattr(row_store, "memory_limit", 10**5)
    steps = 100_000
    recorder, outcome = long_run(steps, 0.1, 0.0)
    result = label_result("fast", recorder, outcome, MasterSettings(tolerance=1.0))
    write_dataset(result.isel(time=slice(2), attempt=slice(1)), tmp_path / "few.nc")
    tracemalloc.start()
    write_dataset(result, tmp_path / "many.nc")
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    # One of eight columns, and the causes as texts of 8 bytes; 57 bytes where xarray encodes them.
    assert peak < 24 * steps
    with xr.open_dataset(tmp_path / "many.nc", engine="h5netcdf") as stored:
        xr.testing.assert_identical(stored.load(), result)


@pytest.mark.slow
def test_a_million_steps_of_cosim_take_no_more_memory_than_a_few(monkeypatch, tmp_path):
    """Kept in memory, points and attempts would be 24 and 37 bytes each: 61 MB in all."""
    steps, size, start = 1_000_000, 1e-3, 0.7
    stop = start + steps * size
    recorder = Weighed(steps // 10)
    opened = AssembledSystem(
        description=SystemDescription(
            name="fast",
            components=(),
            start_time=start,
            stop_time=stop,
            master=MasterChoices(settings={"fixed_step": size}),
        ),
        system=System([Fast("one"), Fast("two")], []),
        sources=(),
        unused=(),
    )
    monkeypatch.setattr(cosim, "open_system", lambda *_, **__: nullcontext(opened))
    monkeypatch.setattr(cosim, "Recorder", lambda: recorder)
    monkeypatch.setattr(row_store, "memory_limit", megabyte)
    result = cosim.run_system(tmp_path / "fast.ssd", CosimOptions())
    # From a tenth of the run on; a chunk is at most 1 MB, and there are two tables.
    assert np.ptp(recorder.weights) < 4 * megabyte
    exact = start + np.arange(steps + 1) * size
    assert recorder.time.tobytes() == exact.tobytes()
    # loads the libraries that write: they weigh the same whatever is written
    write_dataset(result.isel(time=slice(2), attempt=slice(1)), tmp_path / "few.nc")
    before = private_memory()
    write_dataset(result, tmp_path / "fast.nc")
    # One column and the causes as texts are in memory while the file is written.
    assert private_memory() - before < 40 * megabyte
    with xr.open_dataset(tmp_path / "fast.nc", engine="h5netcdf") as stored:
        assert stored.attrs["steps_accepted"] == steps
        assert stored.attrs["simulated_time"] == stop == exact[-1]
        assert stored["time"].to_numpy().tobytes() == exact.tobytes()
        assert stored["attempt_time"].to_numpy().tobytes() == exact[:-1].tobytes()
        assert stored["two.y"].to_numpy().tobytes() == np.arange(steps + 1.0).tobytes()
