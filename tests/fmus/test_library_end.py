"""A process that has run Python FMUs ends without touching what is not there any more."""

import subprocess
import sys
from pathlib import Path

import pytest

from fmu_src.python import library_end
from orchestrator.isolation_setup import IsolationSetup

SOURCE = Path(__file__).with_name("unforgiving.c")
PROGRAM = """
import sys
from tests.fmus.instance import Instance
for path in sys.argv[1:]:
    instance = Instance(path)
    instance.close()
print("done")
"""


@pytest.fixture(scope="module")
def unforgiving(tmp_path_factory):
    library = tmp_path_factory.mktemp("unforgiving") / "unforgiving.so"
    compiler = [sys.executable, "-m", "ziglang", "cc", "-shared", "-fPIC", "-O1"]
    subprocess.run([*compiler, "-o", library, SOURCE], check=True)
    return library


def end_of_process(program, paths, unforgiving):
    return subprocess.run(
        [sys.executable, "-c", program, *map(str, paths)],
        env={"LD_PRELOAD": str(unforgiving), "OPENBLAS_NUM_THREADS": "1"},
        cwd=Path(__file__).parents[2],
        check=False,
        capture_output=True,
        text=True,
    )


@pytest.mark.skipif(sys.platform != "linux", reason="the loader of Linux")
def test_a_process_with_python_fmus_ends_well(small_fmus, unforgiving):
    done = end_of_process(PROGRAM, [small_fmus.track, small_fmus.vehicle], unforgiving)
    assert done.stdout == "done\n"
    assert done.returncode == 0, done.stderr


@pytest.mark.skipif(sys.platform != "linux", reason="the loader of Linux")
def test_without_that_the_library_uses_memory_that_is_free(small_fmus, unforgiving):
    """If this fails, pythonfmu has been mended, and `library_end` can go."""
    program = f"import atexit\natexit.register = lambda *_: None\n{PROGRAM}"
    done = end_of_process(program, [small_fmus.track], unforgiving)
    assert done.stdout == "done\n"
    assert done.returncode < 0


@pytest.mark.skipif(sys.platform != "linux", reason="the loader of Linux")
@pytest.mark.parametrize("program", ["main()", "serve(*streams())"], ids=["isolated", "by itself"])
def test_a_process_of_an_isolated_fmu_leaves_out_the_end_of_its_library(
    program, small_fmus, unforgiving
):
    """So that FMUs that pythonfmu has made for others end well, too; `serve` alone does not."""
    setup = IsolationSetup(path=str(small_fmus.track), name="track").write()
    told = f"""
import atexit, os
atexit.register = lambda *_: None
from orchestrator.frames import write_frame
from orchestrator.isolation_worker import main, serve
there, here = os.pipe()
write_frame(lambda data: os.write(here, data), [{setup!r}])
os.close(here)
os.dup2(there, 0)
streams = lambda: (lambda size: os.read(0, size), lambda data: os.write(1, data))
{program}
"""
    ended = subprocess.run(
        [sys.executable, "-c", told],
        env={"LD_PRELOAD": str(unforgiving), "OPENBLAS_NUM_THREADS": "1"},
        cwd=Path(__file__).parents[2],
        check=False,
        capture_output=True,
    )
    assert (ended.returncode == 0) == (program == "main()"), ended.stderr


def test_the_end_is_left_to_a_thread_that_runs_python_itself(monkeypatch):
    calls = []
    monkeypatch.setattr(library_end.threading, "get_native_id", lambda: 0)
    library_end._end(lambda: calls.append("ended"))
    assert calls == []


def test_a_slave_without_a_library_has_nothing_to_end(monkeypatch, tmp_path):
    registered = []
    monkeypatch.setattr(library_end.atexit, "register", registered.append)
    library_end.end_in_order(None)
    library_end.end_in_order(str(tmp_path / "resources"))
    assert registered == []
