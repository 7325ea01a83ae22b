"""Settings that hold for every test, and the FMUs in C that tests share."""

import os
import sys
from functools import cache
from pathlib import Path

import pytest

# before numpy is loaded: workers must not compete for the cores
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).parent / "compiled"))


pytest_plugins = ["pytester", "railcosim.pytest_plugin"]


@pytest.fixture(scope="session")
def compiled_fmu(tmp_path_factory):
    """Return a function that gives the path of a model in a version, built once."""
    from compiled_fmus import build  # noqa: PLC0415 - importable from here on only

    folder = tmp_path_factory.mktemp("compiled")

    @cache
    def path(model="mass", fmi_version=2):
        return build(folder, f"{model.title()}{fmi_version}", model=model, fmi_version=fmi_version)

    return path
