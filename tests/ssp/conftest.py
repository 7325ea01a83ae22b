"""Make the helpers of this folder importable, and the FMU they share."""

import shutil
import sys
from pathlib import Path

import numpy as np
import pytest

from orchestrator import Master, MasterSettings, Recorder
from orchestrator.ssp import open_system

sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parents[1] / "orchestrator")]


@pytest.fixture(scope="session")
def relay(tmp_path_factory):
    """Return the path of the relay FMU."""
    from relay_fmu import build  # noqa: PLC0415 - importable from here on only

    return Path(build(tmp_path_factory.mktemp("fmus")))


@pytest.fixture(scope="session")
def faulty(tmp_path_factory):
    """Return the path of an FMU with faults on demand."""
    from mass_fmu import build  # noqa: PLC0415 - importable from here on only

    return Path(build(tmp_path_factory.mktemp("fmus"), "FaultyMass"))


@pytest.fixture
def put(relay, tmp_path):
    """Write a description beside the relay FMU and return its path."""
    shutil.copy(relay, tmp_path / "relay.fmu")

    def put(text, name="system.ssd"):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return put


@pytest.fixture
def histories():
    """Run the system of a file over one second and return the histories of its outputs."""

    def histories(path, **settings):
        chosen = MasterSettings(**({"tolerance": None, "fixed_step": 0.25} | settings))
        recorder = Recorder()
        with open_system(path) as opened:
            Master(opened.system, chosen, observers=[recorder]).run(0.0, 1.0)
        return {name: np.array(recorder[name]) for name in recorder.variables}

    return histories
