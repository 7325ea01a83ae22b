"""Connections that convert: the master sees the source's unit, the participant its own."""

import numpy as np
import pytest
from fake_participants import Answering, Fake, oscillators

from orchestrator import (
    Connection,
    Linear,
    Master,
    MasterSettings,
    Recorder,
    RunError,
    Status,
    StatusKind,
    System,
)
from orchestrator.exchange import Exchange

double, half = Linear(2.0), Linear(0.5)


def in_double_units():
    """The same oscillators, the second one in units half as large."""
    system = oscillators()
    first, second = system.participants
    second.variables["force"] = type(second.variables["force"])(
        name="force", causality="output", nominal=200.0
    )
    changes = {"second.displacement": double, "second.velocity": double, "first.force": half}
    wires = [
        Connection(source=item.source, target=item.target, conversion=changes[item.target])
        for item in system.connections
    ]
    return System([first, second], wires)


@pytest.mark.parametrize("algorithm", ["newton", "gauss_seidel", "jacobi"])
def test_other_units_give_the_same_run_bit_for_bit(algorithm):
    """A factor of two does not round, so nothing of the run may change."""
    settings = MasterSettings(tolerance=1e-3, algorithm=algorithm, max_step=0.01, initial_step=1e-4)
    plain, scaled = Recorder(), Recorder()
    first = Master(oscillators(), settings, observers=[plain]).run(0.0, 0.5)
    second = Master(in_double_units(), settings, observers=[scaled]).run(0.0, 0.5)
    assert first.step_log.tobytes() == second.step_log.tobytes()
    assert plain.time.tobytes() == scaled.time.tobytes()
    own = "second.own_displacement"
    assert (2.0 * plain[own]).tobytes() == scaled[own].tobytes()
    assert plain["first.displacement"].tobytes() == scaled["first.displacement"].tobytes()
    assert np.ptp(plain[own]) > 0.0


class Typed(Fake):
    inputs = ("u",)
    outputs = ("y",)

    def __init__(self, name, **details):
        self.details = details
        super().__init__(name)


@pytest.mark.parametrize(
    ("conversion", "low", "high", "nominal"),
    [
        (None, -10.0, 30.0, 4.0),
        (Linear(2.0, 10.0), -10.0, 10.0, 2.0),
        (Linear(-2.0, 10.0), -10.0, 10.0, 2.0),
        (Linear(0.25, 0.0), -40.0, 50.0, 5.0),
    ],
)
def test_bounds_and_nominal_values_are_those_of_the_source(conversion, low, high, nominal):
    """The input takes -10 to 30 in its own unit, the output gives -50 to 50."""
    a = Typed("a", y={"minimum": -50.0, "maximum": 50.0, "nominal": 5.0})
    b = Typed("b", u={"minimum": -10.0, "maximum": 30.0, "nominal": 4.0})
    wire = Connection(source="a.y", target="b.u", conversion=conversion)
    exchange = Exchange(System([a, b], [wire]), indicators=[], observed=[], input_shape="held")
    assert exchange.lower.tolist() == [low]
    assert exchange.upper.tolist() == [high]
    assert exchange.nominal.tolist() == [nominal]


def test_an_error_names_inputs_in_the_unit_of_the_participant():
    def fail(time, _step):
        return Status(StatusKind.ERROR, "it broke") if time > 0.0 else None

    source = Answering("source", lambda _t, _h: 1.5)
    target = Answering("target", fail)
    wire = Connection(source="source.y", target="target.u", conversion=Linear(2.0, 1.0))
    master = Master(
        System([source, target], [wire]), MasterSettings(tolerance=None, fixed_step=0.5)
    )
    with pytest.raises(RunError, match=r"target: it broke .*u = 4"):
        master.run(0.0, 1.0)
