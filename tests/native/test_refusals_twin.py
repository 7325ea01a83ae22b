"""Steps that numpy and native models refuse alike, and that leave everything as it was."""

import numpy as np
import pytest

from fmu_src.native.model_sources import MODELS
from track_fmu.contact_track import LONGEST_PART
from track_fmu.step_parts import MOST_PARTS, count_parts
from track_fmu.track_model import LONGEST_STEP
from vehicle_fmu.integration import MOST_SUBSTEPS

from .library import DiscardedError

LOAD = np.full(2, 117_720.0)
SUBSTEP = 2e-5  # s, the default
POSITIONS = np.array([4.5, 2.7])
STILL = np.zeros(2)


def refuse(step, numpy, native):
    """Sentences with which the numpy and the native model refuse the step."""
    before, own = native.state.tobytes(), numpy.state.tobytes()
    with pytest.raises(DiscardedError) as said:
        step("native")
    assert native.state.tobytes() == before
    with pytest.raises(ValueError, match="step") as also_said:
        step("numpy")
    assert numpy.state.tobytes() == own
    return str(also_said.value), str(said.value)


@pytest.mark.parametrize(
    ("step", "parts"),
    [
        (1.000001 * MOST_SUBSTEPS * SUBSTEP, "100000 substeps of 2e-05 s"),
        (1e300, "100000 substeps of 2e-05 s"),
    ],
)
def test_vehicles_refuse_too_many_substeps_in_the_same_words(vehicle_pair, step, parts):
    pair = vehicle_pair()
    pair.start(0.0, STILL)
    takes = {
        "numpy": lambda: pair.numpy.step(0.0, step, STILL, linear=True),
        "native": lambda: pair.native.step(0.0, step),
    }
    one, other = refuse(lambda model: takes[model](), pair.numpy, pair.native)
    assert one == other == f"a step of {step:g} s is more than {parts}; use a shorter step"


@pytest.mark.parametrize("step", [1.000001 * MOST_SUBSTEPS * SUBSTEP, 1e300])
def test_suspended_masses_refuse_too_many_substeps_in_the_same_words(masses_pair, step):
    pair = masses_pair(values={"model": "suspended"})
    pair.start(0.0, LOAD)
    takes = {
        "numpy": lambda: pair.numpy.step(0.0, step, LOAD, linear=True),
        "native": lambda: pair.native.step(0.0, step),
    }
    one, other = refuse(lambda model: takes[model](), pair.numpy, pair.native)
    parts = "100000 substeps of 2e-05 s"
    assert one == other == f"a step of {step:g} s is more than {parts}; use a shorter step"


def test_the_longest_step_of_a_vehicle_is_taken(vehicle_pair):
    pair = vehicle_pair(values={"substep": 1e-3, "flat.shape": "none"})
    pair.start(0.0, STILL)
    assert pair.native.step(0.0, 1e-3 * MOST_SUBSTEPS) == 1e-3 * MOST_SUBSTEPS


@pytest.mark.parametrize("longest", [LONGEST_STEP, LONGEST_PART])
def test_tracks_refuse_too_many_parts_in_the_same_words(
    track_pair, contact_pair, short_track, longest
):
    inputs = LOAD if longest == LONGEST_STEP else STILL
    pair = (track_pair if longest == LONGEST_STEP else contact_pair)(short_track)
    pair.start(POSITIONS, inputs)
    assert count_parts(MOST_PARTS * longest, longest) == MOST_PARTS
    step = 1.000001 * MOST_PARTS * longest
    takes = {
        "numpy": lambda: pair.numpy.step(step, POSITIONS, inputs, linear=True),
        "native": lambda: pair.native.step(0.0, step),
    }
    one, other = refuse(lambda model: takes[model](), pair.numpy, pair.native)
    parts = f"100000 parts of {longest:g} s"
    assert one == other == f"track: a step of {step:g} s is more than {parts}; use a shorter step"


@pytest.mark.parametrize("model", MODELS)
def test_a_step_that_does_not_move_the_time_on_is_refused(native, model):
    """Else the state would go on while the time stands still, for as many steps as one likes."""
    instance = native(model)
    instance.enter(1000.0)
    instance.exit()
    before = instance.state.tobytes()
    with pytest.raises(DiscardedError, match="a step of 1e-14 s from 1000 s does not move"):
        instance.step(1000.0, 1e-14)
    assert instance.reached == 1000.0
    assert instance.state.tobytes() == before
    spacing = np.spacing(1000.0)
    assert instance.step(1000.0, spacing) == 1000.0 + spacing


@pytest.mark.parametrize("shape", ["held", "linear"])
def test_masses_refuse_what_leaves_the_range_of_numbers_in_the_same_words(masses_pair, shape):
    linear = shape == "linear"
    pair = masses_pair(values={"linear_inputs": linear})
    pair.start(0.0, LOAD)
    forces = np.array([LOAD[0], 1e300])
    pair.native.set_group("wheel[#].contact_force", forces)
    takes = {
        "numpy": lambda: pair.numpy.step(0.0, 1e9, forces, linear=linear),
        "native": lambda: pair.native.step(0.0, 1e9),
    }
    one, other = refuse(lambda model: takes[model](), pair.numpy, pair.native)
    assert one == other
    assert one.startswith("the contact force of 1e+300 N on wheel 2 drives the wheel to -inf m at")


def test_masses_and_vehicles_refuse_places_that_are_no_numbers(masses_pair, vehicle_pair):
    values = {"speed": 1e300, "flat.shape": "none", "substep": 1e10}
    masses, vehicle = masses_pair(values={"speed": 1e300}), vehicle_pair(values=values)
    for pair, inputs in ((masses, LOAD), (vehicle, STILL)):
        pair.start(0.0, inputs)
        takes = {
            "numpy": lambda pair=pair, inputs=inputs: pair.numpy.step(
                0.0, 1e14, inputs, linear=True
            ),
            "native": lambda pair=pair: pair.native.step(0.0, 1e14),
        }
        one, other = refuse(lambda model, takes=takes: takes[model](), pair.numpy, pair.native)
        assert one == other
        assert one.startswith("wheel 1 would be at inf m at 1e+14 s")


def test_contacts_refuse_steps_that_rates_cannot_follow(contact_pair, short_track):
    """A move within next to no time is a speed that is no number."""
    pair = contact_pair(short_track, values={"linear_inputs": True})
    pair.start(POSITIONS, STILL)
    pair.set(POSITIONS + 1e-3, STILL)
    before = pair.native.state.tobytes()
    with pytest.raises(DiscardedError, match="did not converge"):
        pair.native.step(0.0, 5e-324)
    assert pair.native.state.tobytes() == before
