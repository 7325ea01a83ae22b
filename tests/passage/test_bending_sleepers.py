"""The passage over sleepers that bend, with the ballast's law at every point of them."""

import numpy as np
import pytest

from .full_model import LOAD, FullModel, haversine

STRUCK = 7.525 * 0.65 + 0.02  # m; in the middle bay of fourteen
SHORT = {"bays": 14, "sleeper": "beam", "sleeper_elements": 4}


def strike(model):
    """Half a metre before a flat to a third behind it."""
    return model.run(
        speed=40.0 / 3.6,
        drop=lambda x: haversine(x - STRUCK),
        start=STRUCK - 0.6,
        stop=STRUCK + 0.3,
        step=5e-5,
    )


@pytest.fixture(scope="module")
def local():
    """Every point of a sleeper presses on ballast of its own."""
    return strike(FullModel(**SHORT, local=True))


def off(passage, local):
    """Peak force, largest sleeper displacement and force at any time, how far they are off."""
    return (
        passage.force.max() / local.force.max() - 1.0,
        passage.sleeper.max() / local.sleeper.max() - 1.0,
        np.abs(passage.force - local.force).max() / LOAD,
    )


def test_one_spread_force_per_sleeper_stands_for_the_ballast_at_every_point(local):
    peak, sleeper, force = off(strike(FullModel(**SHORT)), local)
    assert abs(peak) < 0.006
    assert 0.0 < sleeper < 0.04
    assert force < 0.035


def test_that_is_better_than_a_rigid_sleeper_or_a_plain_mean(local):
    rigid = off(strike(FullModel(bays=14)), local)
    even = FullModel(**SHORT)
    even.beds = np.add.reduceat(
        FullModel(**SHORT, local=True).beds * local_shares(), np.arange(0, 13 * 8, 8), axis=1
    )
    plain = off(strike(even), local)
    assert rigid[2] > 0.07
    assert plain[2] > 0.09
    assert plain[1] > 0.1


def local_shares():
    return FullModel(**SHORT, local=True).share
