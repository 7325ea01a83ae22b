import pytest
from distributed import Client, LocalCluster

from railcosim.sweep import parse_study, run_study

CHEAP = """
[base]
track.bays = 8
track.elements_per_bay = 4
vehicle.wheels = 1
run.approach = 0.15
run.departure = 0.11
options.fmus = "python"
"""
"""A passage of a third of a second, on FMUs that need no compiler."""


@pytest.fixture(scope="session")
def cheap():
    return CHEAP


@pytest.fixture(scope="session")
def client():
    """A worker of dask in this process, so that tests can look inside it."""
    with (
        LocalCluster(
            n_workers=1, threads_per_worker=1, processes=False, dashboard_address="127.0.0.1:0"
        ) as cluster,
        Client(cluster, set_as_default=False) as client,
    ):
        yield client


@pytest.fixture
def sweep(cheap, client, tmp_path):
    """Run a study in this process; gives its result and which cases were run."""

    def sweep(text, *, store=tmp_path / "store", folder=tmp_path, **options):
        seen = []
        study = parse_study(cheap + text, folder=folder)
        result = run_study(study, store=store, client=client, report=seen.append, **options)
        return result, seen[-1]

    return sweep
