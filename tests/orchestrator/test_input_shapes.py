"""Inputs over a step: by their derivatives, by a parameter, or held; and the orders that follow."""

import logging
from itertools import pairwise

import numpy as np
import pytest
from compiled_fmus import build
from fake_participants import Linear, oscillators_exact

from orchestrator import (
    OK,
    Connection,
    FmuParticipant,
    IsolatedParticipant,
    Master,
    MasterSettings,
    Recorder,
    System,
)

force = ["force"]


def started(participant, *, observed=(), first=0.0, input_shape="linear"):
    participant.bind(
        inputs=force, outputs=["x", "v", "a"], observed=list(observed), input_shape=input_shape
    )
    participant.instantiate()
    participant.enter_initialisation(start_time=0.0, stop_time=1.0, tolerance=None)
    assert participant.set_inputs(np.array([first])) is OK
    participant.exit_initialisation()
    return participant


def step(participant, time, size, end):
    assert participant.set_inputs(np.array([end])) is OK
    assert participant.step(time, size) is OK
    out = np.empty(3)
    assert participant.get_outputs(out) is OK
    return out


@pytest.mark.parametrize(
    ("fmi_version", "claims", "values", "wish", "way"),
    [
        (2, {}, {}, "linear", "on straight lines, by the derivatives of FMI 2.0"),
        (2, {}, {}, "held", "held"),
        (2, {}, {"linear_inputs": True}, "linear", "on straight lines, by the parameter"),
        (2, {}, {"linear_inputs": False}, "linear", "held"),
        (2, {"canInterpolateInputs": False}, {}, "linear", "on straight lines, by the parameter"),
        (3, {}, {}, "linear", "on straight lines, by the parameter linear_inputs"),
        (3, {}, {}, "held", "held"),
    ],
)
def test_the_log_says_how_inputs_run(tmp_path, caplog, fmi_version, claims, values, wish, way):
    """The standard's way first; a choice of the user before all."""
    path = build(tmp_path, "Mass", fmi_version=fmi_version, **claims)
    mass = FmuParticipant(path, name="mass", start_values=values)
    with caplog.at_level(logging.INFO, logger="orchestrator"):
        mass.bind(inputs=force, outputs=[], observed=[], input_shape=wish)
    assert f"mass takes its inputs over a step {way}" in caplog.text
    assert mass.input_shape == ("held" if way == "held" else "linear")


def test_an_fmu_without_any_way_holds_its_inputs(compiled_fmu, caplog):
    gain = FmuParticipant(compiled_fmu("gain", 3), name="gain")
    with caplog.at_level(logging.INFO, logger="orchestrator"):
        gain.bind(inputs=["u"], outputs=[], observed=[], input_shape="linear")
    assert "gain takes its inputs over a step held" in caplog.text


@pytest.mark.parametrize("fmi_version", [2, 3])
@pytest.mark.parametrize("kind", [FmuParticipant, IsolatedParticipant])
def test_a_force_on_straight_lines_moves_the_mass_exactly(compiled_fmu, fmi_version, kind):
    """f = 6 t from rest at x = 1: v = 3 t^2, x = 1 + t^3, a = f at the end of the step.

    With repeated steps, steps of other sizes, and values that were never set but went along with
    a state: all that could bring a wrong start of the line.
    """
    mass = started(kind(compiled_fmu("mass", fmi_version)), observed=["force", "x"])
    try:
        state = mass.save()
        assert step(mass, 0.0, 0.5, 99.0)[0] > 2.0
        mass.restore(state)
        assert step(mass, 0.0, 0.25, 1.5) == pytest.approx([1.0 + 0.25**3, 0.1875, 1.5], abs=1e-15)
        seen = np.empty(2)
        assert mass.get_observed(seen) is OK
        assert seen == pytest.approx([1.5, 1.0 + 0.25**3], abs=1e-15)
        quarter = mass.save()
        data = mass.serialise(quarter)
        step(mass, 0.25, 0.125, -7.0)
        mass.restore(quarter)
        assert step(mass, 0.25, 0.5, 4.5) == pytest.approx([1.0 + 0.75**3, 1.6875, 4.5], abs=1e-15)
        mass.restore(mass.deserialise(data))
        assert step(mass, 0.25, 0.75, 6.0) == pytest.approx([2.0, 3.0, 6.0], abs=1e-15)
        # Nothing set: the force stays where it is.
        assert mass.step(1.0, 1.0) is OK
        out = np.empty(3)
        assert mass.get_outputs(out) is OK
        assert out == pytest.approx([8.0, 9.0, 6.0], abs=1e-14)
    finally:
        mass.free()


def test_the_first_line_begins_at_the_initial_force(compiled_fmu):
    mass = started(FmuParticipant(compiled_fmu("mass", 2)), first=2.0)
    try:
        # x = 1 + h^2 (2 f0 + f1) / 6
        assert step(mass, 0.0, 1.0, 5.0)[0] == 2.5
    finally:
        mass.free()


def pair(first_path, second_path, **start_values):
    """Two masses of C, each on a spring, with a spring and a damper between them in Python."""
    k, kc, dc = 10.0, 10.0, 0.5
    masses = [
        FmuParticipant(path, name=name, start_values=values)
        for name, path, values in (
            ("first", first_path, start_values),
            ("second", second_path, start_values),
        )
    ]
    springs = Linear(
        "springs",
        inputs=["x1", "x2", "v1", "v2"],
        outputs=["force1", "force2"],
        A=np.zeros((1, 1)),
        B=np.zeros((1, 4)),
        C=np.zeros((2, 1)),
        # The masses start at x = 1, so that the second spring is shorter by what it would pull.
        D=[[-k - kc, kc, -dc, dc], [kc, -k - kc, dc, -dc]],
        e=[-kc, k + kc],
        x0=[0.0],
        details={"force1": {"nominal": 10.0}, "force2": {"nominal": 10.0}},
    )
    wires = [
        Connection(source=f"{name}.{end}", target=f"springs.{end}{n}")
        for n, name in ((1, "first"), (2, "second"))
        for end in "xv"
    ]
    wires += [
        Connection(source="springs.force1", target="first.force"),
        Connection(source="springs.force2", target="second.force"),
    ]
    return System([*masses, springs], wires)


def error_at_the_end(system, step_size, **settings):
    """The second mass is measured from x = 1, so that it starts at rest where its spring is."""
    recorder = Recorder(["first.x", "second.x"])
    chosen = MasterSettings(tolerance=None, fixed_step=step_size, **settings)
    Master(system, chosen, observers=[recorder]).run(0.0, 2.0)
    exact = oscillators_exact(2.0, kc=10.0, dc=0.5)
    ends = np.array([recorder["first.x"][-1], recorder["second.x"][-1] - 1.0])
    return float(np.abs(ends - exact[:2]).max())


@pytest.mark.parametrize(
    ("versions", "start_values", "order"),
    [
        ((2, 2), {}, 2),
        ((3, 3), {}, 2),
        ((2, 3), {}, 2),
        ((2, 3), {"linear_inputs": False}, 1),
    ],
    ids=["derivatives", "linear_inputs", "one of each", "held"],
)
def test_observed_order_of_newton(compiled_fmu, versions, start_values, order):
    paths = [compiled_fmu("mass", version) for version in versions]
    errors = [
        error_at_the_end(pair(*paths, **start_values), 2.0 / steps) for steps in (100, 200, 400)
    ]
    observed = [np.log2(coarse / fine) for coarse, fine in pairwise(errors)]
    # At these steps the next term of the error changes the order by a few hundredths.
    assert observed == pytest.approx([order, order], abs=0.1)


@pytest.mark.parametrize("algorithm", ["gauss_seidel", "jacobi"])
def test_derivatives_and_the_parameter_are_the_same_line(compiled_fmu, algorithm):
    """Explicit algorithms too: both lines go from the last value set to the next."""
    results = []
    for version in (2, 3):
        path = compiled_fmu("mass", version)
        results.append(error_at_the_end(pair(path, path), 0.01, algorithm=algorithm))
    assert results[0] == pytest.approx(results[1], rel=1e-9)
