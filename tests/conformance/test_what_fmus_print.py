"""FMUs that print to stdout do not spoil the result that goes there."""

import json
import os
import subprocess
import sys

import pytest
from pythonfmu.builder import FmuBuilder

from tests.conformance import systems as s

talkative = """
import ctypes

from pythonfmu import Fmi2Causality, Fmi2Slave, Real

# pythonfmu 0.7 gives back a reference to this namespace that it never took (its issue 228).
globals().setdefault("namespaces", []).append(globals())


class Talkative(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.y = 0.0
        self.register_variable(Real("y", causality=Fmi2Causality.output))

    def do_step(self, time, step):
        print("printed by Python")
        ctypes.CDLL(None).printf(b"printed by C, and left in its buffer")
        self.y = time + step
        return True
"""


@pytest.fixture(scope="module")
def talkative_system(tmp_path_factory):
    """Return the description of a system of one FMU that prints in every step."""
    folder = tmp_path_factory.mktemp("talkative")
    source = folder / "talkative.py"
    source.write_text(talkative, encoding="utf-8")
    built = FmuBuilder.build_FMU(source, dest=folder, needsExecutionTool=False)
    path = folder / "talkative.ssd"
    text = s.system([s.component("a", built.name, [], ["y"])], [], stop=1.0)
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("isolated", [(), ("--isolate",)])
def test_stdout_holds_the_result_only(talkative_system, isolated):
    command = [sys.executable, "-m", "railcosim", "cosim", str(talkative_system), "--step", "0.25"]
    done = subprocess.run(
        [*command, "--json", "--quiet", *isolated],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    )
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["final"] == {"a.y": 1.0}
    assert done.stderr.count("printed by Python") == 4
    assert done.stderr.count("printed by C") == 4
