"""Make the helpers of this folder importable, and the FMU they share."""

import sys
import tempfile
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))


@pytest.fixture(scope="session")
def fmu(tmp_path_factory):
    """Return the path of the mass FMU."""
    from mass_fmu import build  # noqa: PLC0415 - importable from here on only

    return build(tmp_path_factory.mktemp("fmus"), "OrchestratorTestMass")


@pytest.fixture
def unpacked(tmp_path, monkeypatch):
    """Return the folder in which FMUs are unpacked."""
    folder = tmp_path / "unpacked"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    return folder
