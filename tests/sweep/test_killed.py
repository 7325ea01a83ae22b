"""What is killed loses nothing: the command line by kill -9, a worker in the middle of a case."""

import os
import random
import signal
import subprocess
import sys
import time
from contextlib import contextmanager

import dask
import psutil
import pytest
import xarray as xr
from distributed import Client, LocalCluster

from railcosim.errors import RunError
from railcosim.output import write_dataset
from railcosim.sweep import SweepProgress, parse_study, run_study
from railcosim.sweep.cluster import local_client
from railcosim.sweep.engine import KILLED
from railcosim.sweep.work import run_case_on_worker

STUDY = """
[sweep.grid]
vehicle.speed_kmh = { from = 50, to = 70, step = 5 }
[keep]
signals = ["contact_force"]
spacing = 0.01
"""
CASES = 5


@pytest.fixture(scope="module")
def undisturbed(cheap, client, tmp_path_factory):
    """The bytes of the result of a study that was let run."""
    folder = tmp_path_factory.mktemp("undisturbed")
    result = run_study(parse_study(cheap + STUDY), store=folder / "store", client=client)
    write_dataset(result, folder / "study.nc")
    return (folder / "study.nc").read_bytes()


@pytest.mark.parametrize("kills", [1, pytest.param(3, marks=pytest.mark.slow)])
def test_a_sweep_killed_at_random_moments_goes_on_to_the_same_result(
    cheap, undisturbed, tmp_path, kills
):
    """To the byte, whatever the moment; cases that had ended are not run again."""
    seed = time.time_ns()
    print(f"moments of the kills: seed {seed}")  # noqa: T201 - shown if the test fails
    moments = random.Random(seed)  # noqa: S311 - not for secrets
    path, store = tmp_path / "study.toml", tmp_path / "study.store"
    path.write_text(cheap + STUDY)
    command = [sys.executable, "-m", "railcosim", "sweep", str(path), "--workers", "1"]
    for kill in range(kills):
        process = subprocess.Popen(
            command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True
        )
        wanted = kill + 1  # cases: something is stored, something is left
        while len(stored(store)) < wanted and process.poll() is None:
            time.sleep(0.01)
        time.sleep(moments.uniform(0.0, 0.15))
        children = psutil.Process(process.pid).children(recursive=True)
        process.kill()
        assert process.wait(timeout=60) == -signal.SIGKILL
        _, alive = psutil.wait_procs(children, timeout=60)
        assert alive == []  # workers end with the sweep
        assert not path.with_suffix(".nc").exists()
    before = {path: path.stat().st_mtime_ns for path in stored(store)}
    assert kills <= len(before) < CASES
    done = subprocess.run([*command, "--quiet"], check=False, capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert {path: path.stat().st_mtime_ns for path in before} == before
    assert len(stored(store)) == CASES
    written = path.with_suffix(".nc")
    with xr.open_dataset(written, engine="h5netcdf") as result:
        assert result.attrs["study"] == cheap + STUDY
    assert written.read_bytes() == undisturbed


def stored(store):
    return sorted(store.glob("[0-9a-f]" * 32 + ".json"))


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupted_sweep_says_how_far_it_is(cheap, tmp_path, number):
    """Ctrl-C reaches the workers as well."""
    path, store = tmp_path / "study.toml", tmp_path / "study.store"
    path.write_text(cheap + STUDY)
    command = [sys.executable, "-m", "railcosim", "sweep", str(path), "--workers", "1"]
    process = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True, text=True
    )
    while not stored(store) and process.poll() is None:
        time.sleep(0.01)
    children = psutil.Process(process.pid).children(recursive=True)
    if number == signal.SIGINT:
        os.killpg(process.pid, number)
    else:
        process.send_signal(number)
    out, err = process.communicate(timeout=60)
    assert (process.returncode, out) == (1, "")
    assert f"of {CASES} cases stored; the same command goes on" in err.splitlines()[-1]
    assert "Traceback" not in err
    assert psutil.wait_procs(children, timeout=60)[1] == []
    assert 0 < len(stored(store)) < CASES


def test_a_sweep_interrupted_while_its_workers_start_closes_them(monkeypatch):
    """Ctrl-C comes in the middle of the construction of the cluster."""
    made = []

    class Cluster:
        def __init__(self, **_):
            made.append(self)
            self.closed = False
            signal.raise_signal(signal.SIGINT)

        def close(self):
            self.closed = True

    monkeypatch.setattr("distributed.LocalCluster", Cluster)
    with pytest.raises(KeyboardInterrupt), local_client(1, 1):
        pass
    assert [cluster.closed for cluster in made] == [True]


@pytest.mark.parametrize("error", [RuntimeError("Nanny failed to start."), OSError("no room")])
def test_workers_that_cannot_be_started_are_said_to_be_so(monkeypatch, error):
    def fail(**_):
        raise error

    monkeypatch.setattr("distributed.LocalCluster", fail)
    with pytest.raises(RunError, match=f"cannot be started .{error}"), local_client(1, 1):
        pass


@contextmanager
def own_worker():
    """Start a worker in a process of its own."""
    with (
        LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address="127.0.0.1:0") as cluster,
        Client(cluster, set_as_default=False) as client,
    ):
        yield client


def test_a_worker_killed_in_the_middle_of_a_case_loses_nothing(cheap, undisturbed, tmp_path):
    """Its nanny starts another one, and the scheduler gives it the case again."""
    killed = []
    with own_worker() as client:

        def kill_once(progress):
            if progress.ended == 2:
                killed.extend(client.run(os.getpid).values())
                os.kill(killed[0], signal.SIGKILL)

        result = run_study(
            parse_study(cheap + STUDY), store=tmp_path / "store", client=client, report=kill_once
        )
        assert [*client.run(os.getpid).values()] != killed
    assert [*result["failure"].to_numpy().ravel()] == [""] * CASES
    write_dataset(result, tmp_path / "study.nc")
    assert (tmp_path / "study.nc").read_bytes() == undisturbed


@pytest.mark.slow
def test_a_case_that_kills_its_workers_is_a_failure_and_the_rest_goes_on(
    cheap, tmp_path, monkeypatch
):
    def poisoned(case, key, store):
        if case.scenario.vehicle.speed_kmh == 60.0:
            os.kill(os.getpid(), signal.SIGKILL)
        return run_case_on_worker(case, key, store)

    monkeypatch.setattr("railcosim.sweep.engine.run_case_on_worker", poisoned)
    with dask.config.set({"distributed.scheduler.allowed-failures": 0}), own_worker() as client:
        seen = []
        study = parse_study(cheap + "[sweep.grid]\nvehicle.speed_kmh = [60, 80]\n")
        result = run_study(study, store=tmp_path / "store", client=client, report=seen.append)
    assert seen[-1] == SweepProgress(total=2, stored=0, ended=2, failed=1)
    assert result["failure"].to_numpy().tolist() == [KILLED, ""]
