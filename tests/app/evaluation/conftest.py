import numpy as np
import pytest

SPEED = 40.0 / 3.6


@pytest.fixture
def record(make_passage):
    """Make a passage whose contact forces are given functions of time, recorded every 20 us."""

    def record(*functions, seconds=0.5, scenario=None, step=20e-6):
        times = np.arange(round(seconds / step) + 1) * step
        distance = SPEED * (times - 0.5 * seconds)
        forces = {k: function(times) for k, function in enumerate(functions, start=1)}
        return make_passage(distance, scenario, series={"contact_force": forces})

    return record


@pytest.fixture
def tone():
    """Make a sine of given amplitude and frequency on a static force."""

    def tone(amplitude, frequency, static=1e5):
        return lambda t: static + amplitude * np.sin(2.0 * np.pi * frequency * t)

    return tone
