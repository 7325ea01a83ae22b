"""A wheel flat passes over the track that finds its contact forces, in both implementations.

Neither iterates: all outputs are passed on between the steps, then both models step.
"""

import numpy as np
import pytest

from fmu_src.native.model_resources import track_resource
from track_fmu.parameters import TrackParameters

from .contact_twins import ContactPair, MassesPair
from .twins import assert_alike

SPEED = 40.0 / 3.6
FLAT = 16.6
STATIC_LOAD = 117_720.0
STEP = 1e-4  # s
AGREEMENT = 1e-9


@pytest.fixture(scope="module")
def full_track():
    parameters = TrackParameters()
    resource = track_resource(parameters, wheels=2, gauges=3, mode_pairs=150, contact=True)
    return parameters, resource


@pytest.fixture
def passage(native, full_track):
    """Runs both; the contact forces of the native wheels, shape (steps, wheels)."""

    def run(*, approach, departure, **flat):
        parameters, resource = full_track
        values = {"initial_speed": SPEED} | {f"flat.{name}": value for name, value in flat.items()}
        track = ContactPair(native, parameters, resource, gauges=3, pairs=150, values=values)
        masses = MassesPair(native, values={"initial_position": FLAT - approach, "speed": SPEED})
        track.start(FLAT - approach - np.array([0.0, 1.8]), np.zeros(2))
        masses.start(0.0, np.full(2, STATIC_LOAD))
        forces = []
        for k in range(round((approach + departure) / SPEED / STEP)):
            step_numpy(track.numpy, masses.numpy)
            step_native(track.native, masses.native)
            forces.append(track.native.group("wheel[#].contact_force"))
            if k % 20 == 19:
                assert_alike([*track.outputs(), *masses.outputs()], relative=AGREEMENT)
        return np.array(forces)

    return run


def step_numpy(track, masses):
    """On sums of steps, as the native ones: a rounding may decide on which supports are nearest."""
    force, position, displacement = track.contact_force, masses.position, masses.displacement
    track.step(STEP, position, displacement, linear=False)
    masses.step(float(masses.state[1]), STEP, force, linear=False)


def step_native(track, masses):
    for name in ("position", "displacement"):
        track.set_group(f"wheel[#].{name}", masses.group(f"wheel[#].{name}"))
    masses.set_group("wheel[#].contact_force", track.group("wheel[#].contact_force"))
    for model in (track, masses):
        model.step(model.time, STEP)


def test_over_the_flat(passage):
    forces = passage(approach=0.06, departure=0.1)
    assert np.max(forces[:, 0]) > 1.5 * STATIC_LOAD


def test_over_a_flat_that_loses_contact(passage):
    forces = passage(approach=0.06, departure=0.2, depth=2e-3)
    assert np.min(forces) == 0.0
    assert forces[-1, 0] > 0.0


@pytest.mark.slow
def test_whole_passage(passage):
    """Its peak is that of the pair with the contacts on the vehicle's side."""
    forces = passage(approach=3.9, departure=2.6)
    assert np.max(forces[:, 0]) == pytest.approx(234e3, rel=0.01)
