"""The FMUs of the conformance suite, and how its tests run systems of them."""

import itertools
import tempfile
from pathlib import Path

import pytest
from typer.testing import CliRunner

from railcosim import cli
from railcosim.cosim import run_system
from railcosim.cosim_options import CosimOptions
from tests.conformance import faulty_fmu, mechanics_fmu
from tests.orchestrator import mass_fmu

counter = itertools.count()


@pytest.fixture(scope="session")
def fmus(tmp_path_factory):
    """Return the folder of the FMUs."""
    folder = tmp_path_factory.mktemp("conformance")
    mechanics_fmu.build(folder)
    faulty_fmu.build(folder)
    for name, options in (
        ("ConformanceTrouble", {}),
        ("ConformanceOnward", {"canGetAndSetFMUstate": False, "canSerializeFMUstate": False}),
    ):
        mass_fmu.build(folder, name, **options)
    return folder


@pytest.fixture
def put(fmus):
    """Write a description beside the FMUs and return its path."""

    def put(text):
        path = fmus / f"system{next(counter)}.ssd"
        path.write_text(text, encoding="utf-8")
        return path

    return put


@pytest.fixture
def run(put):
    """Run a description with the options of `railcosim cosim`."""
    return lambda text, **options: run_system(put(text), CosimOptions(**options))


@pytest.fixture
def unpacked(tmp_path, monkeypatch):
    """Return the folder of all temporary files."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    return folder


@pytest.fixture
def call(put, unpacked):
    """Call `railcosim cosim` on a description; no temporary folder may be left."""

    def call(text, *arguments):
        result = CliRunner().invoke(cli.app, ["cosim", str(put(text)), *map(str, arguments)])
        assert list(Path(unpacked).iterdir()) == []
        return result

    return call
