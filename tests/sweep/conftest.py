import pytest

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
