import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))


@pytest.fixture(scope="session")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("hosts")


@pytest.fixture(scope="session")
def rows(folder):
    """The rows of `benchmarks/hosts.py` by host and FMUs."""
    from host_tools.rows import make_rows  # noqa: PLC0415 - importable from here on only

    return {(row.host, row.fmus): row for row in make_rows(folder)}


@pytest.fixture(scope="session")
def own_peak(folder):
    """Peak force of this project's own master, which iterates and controls its error."""
    from host_tools.rows import own_run  # noqa: PLC0415 - as above

    return own_run(folder).run().largest[0]
