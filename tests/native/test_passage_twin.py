"""A wheel flat passes over the track: native models in a loop, numpy models in the same loop."""

import numpy as np
import pytest

from fmu_src.native.model_resources import track_resource
from track_fmu.parameters import TrackParameters
from vehicle_fmu.contact import hertz_stiffness

from .twins import TRACK_GROUPS, VEHICLE_GROUPS, TrackPair, VehiclePair

SPEED = 40.0 / 3.6
FLAT = 16.6
STATIC_LOAD = 117_720.0
STEP = 1e-4  # s
SETTLED = 1e-15  # m; of displacements of 1 mm
MOST_ITERATIONS = 60
AGREEMENT = 1e-9
NOISE = {"rail_velocity": 0.1, "gap": 1e-4, "velocity": 0.1, "contact_force": 1e5}
"""Orders of magnitude of what may cancel."""


@pytest.fixture(scope="module")
def full_track():
    parameters = TrackParameters()
    return parameters, track_resource(parameters, wheels=2, gauges=3, mode_pairs=150)


@pytest.fixture
def pairs(native, full_track):
    def make(approach):
        parameters, resource = full_track
        start = {"initial_position": FLAT - approach, "speed": SPEED}
        return TrackPair(native, parameters, resource, speed=SPEED), VehiclePair(
            native, values=start
        )

    return make


class Loop:
    """One implementation of both models, each step iterated from saved states until it settles."""

    def __init__(self, rail, *, save, restore, step, outputs, share):
        self.save, self.restore, self.step, self.outputs = save, restore, step, outputs
        self.rail, self.share = rail, share

    def run(self, steps):
        for _ in range(steps):
            before, rail = self.save(), self.rail
            for _ in range(MOST_ITERATIONS):
                self.restore(before)
                found = self.step(rail)
                if np.max(np.abs(found - rail)) <= SETTLED:
                    break
                rail = rail + self.share * (found - rail)
            else:
                pytest.fail("a step of the loop did not settle")
            self.rail = found


def loops(track, vehicle):
    """The numpy loop and the native one, each on its own results."""
    positions = vehicle.numpy.parameters.initial_position - np.array([0.0, 1.8])
    track.start(positions, np.full(2, STATIC_LOAD))
    vehicle.start(0.0, track.numpy.rail_displacement)
    models = (track.numpy, vehicle.numpy), (track.native, vehicle.native)

    def step_numpy(rail):
        track_model, model = models[0]
        model.step(float(model.state[1]), STEP, rail, linear=True)
        track_model.step(STEP, model.position, model.contact_force, linear=True)
        return track_model.rail_displacement

    def step_native(rail):
        model = vehicle.native
        model.set_group("wheel[#].rail_displacement", rail)
        model.step(model.time, STEP)
        track.set(model.group("wheel[#].position"), model.group("wheel[#].contact_force"))
        track.native.step(track.native.time, STEP)
        return track.native.group("wheel[#].rail_displacement")

    def numpy_outputs():
        seen = track.numpy.observe()
        outputs = {
            name: getattr(track.numpy if name == "rail_displacement" else seen, name)
            for name in TRACK_GROUPS
        }
        return outputs | {name: getattr(vehicle.numpy, name) for name in VEHICLE_GROUPS}

    def native_outputs():
        outputs = {name: track.native.group(group) for name, group in TRACK_GROUPS.items()}
        own = {name: vehicle.native.group(f"wheel[#].{name}") for name in VEHICLE_GROUPS}
        return outputs | own

    def restore(pair, states):
        for model, state in zip(pair, states, strict=True):
            model.state = state

    rail, share = track.numpy.rail_displacement, newton_share(track)
    return [
        Loop(
            rail,
            save=lambda pair=pair: [model.state for model in pair],
            restore=lambda states, pair=pair: restore(pair, states),
            step=step,
            outputs=outputs,
            share=share,
        )
        for pair, step, outputs in (
            (models[0], step_numpy, numpy_outputs),
            (models[1], step_native, native_outputs),
        )
    ]


def newton_share(track):
    """What part of a residual to correct by: one over one plus the gain of the loop at rest."""
    before = track.native.state
    track.native.step(0.0, STEP)
    compliance = track.native.derivative(
        ["wheel[1].rail_displacement"], ["wheel[1].contact_force"], [1.0]
    )
    track.native.state = before
    return 1.0 / (1.0 + compliance * hertz_stiffness(STATIC_LOAD, 9.17e10))


def compare(pairs, *, approach, departure):
    """Run both over the flat; the largest contact force of the native ones."""
    numpy, native = loops(*pairs(approach))
    steps = round((approach + departure) / SPEED / STEP)
    peak = 0.0
    for _ in range(steps // 20):
        numpy.run(20)
        for _ in range(20):
            native.run(1)
            peak = max(peak, float(native.outputs()["contact_force"][0]))
        expected, found = numpy.outputs(), native.outputs()
        for name, values in expected.items():
            scale = max(np.max(np.abs(values)), NOISE.get(name, 0.0))
            np.testing.assert_allclose(
                found[name], values, rtol=0.0, atol=AGREEMENT * scale, err_msg=name
            )
    return peak


def test_over_the_flat(pairs):
    assert compare(pairs, approach=0.06, departure=0.1) > 1.5 * STATIC_LOAD


@pytest.mark.slow
def test_whole_passage(pairs):
    assert compare(pairs, approach=3.9, departure=2.6) == pytest.approx(234e3, rel=0.01)
