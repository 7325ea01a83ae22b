"""A step with an input that is no number is refused alike by all kinds of FMU, whatever input."""

import math

import pytest

from fmu_src.native.model_sources import MODELS
from fmu_src.python.masses_slave import MassesSlave
from fmu_src.python.track_contact_slave import TrackContactSlave
from fmu_src.python.track_slave import TrackSlave
from fmu_src.python.vehicle_slave import VehicleSlave

from .library import INPUT, DiscardedError

STEP = 1e-4  # s
SLAVES = {
    "track": TrackSlave,
    "vehicle": VehicleSlave,
    "track_contact": TrackContactSlave,
    "masses": MassesSlave,
}
PAIRS = 36


@pytest.fixture
def slave(short_track):
    """Return a function that makes the Python slave of a model, at its first step."""

    def make(model):
        class Slave(SLAVES[model]):
            bays, elements_per_bay = short_track.bays, short_track.elements_per_bay
            wheels, gauges = 2, 2

        made = Slave(instance_name="one")
        if "mode_pairs" in made._parameters:
            made._parameters["mode_pairs"] = PAIRS
        made.setup_experiment(0.0, None, None)
        made.enter_initialization_mode()
        made.exit_initialization_mode()
        return made

    return make


def inputs_of(instance):
    """Names of all inputs of a native model."""
    numbers = [
        range(group.first, group.first + group.count)
        for group in instance.groups
        if group.causality == INPUT
    ]
    return [instance.names[number] for group in numbers for number in group]


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("model", MODELS)
def test_every_input_must_be_a_number_at_every_step(native, slave, model, value):
    """Those that matter during the initialisation only, too; the same step works afterwards."""
    instance, other = native(model), slave(model)
    instance.enter()
    instance.exit()
    reference = {variable.name: place for place, variable in other.vars.items()}
    names = inputs_of(instance)
    assert names == list(other._inputs.places)
    for name in names:
        before, own = instance.state.tobytes(), other._model.state.tobytes()
        usual = float(instance.get([name])[0])
        instance.set_one(name, value)
        other.set_real([reference[name]], [value])
        with pytest.raises(DiscardedError) as refused:
            instance.step(0.0, STEP)
        assert not other.do_step(0.0, STEP)
        for sentence in (other.log_queue.pop().msg, str(refused.value)):
            assert f"{value:g} " in sentence, name
        instance.set_one(name, usual)
        other.set_real([reference[name]], [usual])
        assert (instance.state.tobytes(), other._model.state.tobytes()) == (before, own)
    assert instance.step(0.0, STEP) == STEP
    assert other.do_step(0.0, STEP)
