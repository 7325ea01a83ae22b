import pytest

from track_fmu.parameters import TrackParameters

from .reference import Track


@pytest.fixture(scope="session")
def table1():
    """The track of Table 1 with 150 mode pairs."""
    return Track(150)


@pytest.fixture(scope="session")
def short():
    """Eight bays of the track of Table 1 with all of its modes."""
    parameters = TrackParameters(bays=8, elements_per_bay=4)
    return Track(2 * (parameters.elements - 1) + parameters.supports, bays=8, elements_per_bay=4)
