"""A spring and a compliance in series close an algebraic loop of gain k D."""

import numpy as np
import pytest
from fake_participants import Fake

from orchestrator import (
    Connection,
    DivergenceError,
    InitialisationError,
    LoopGainError,
    Master,
    MasterSettings,
    Recorder,
    System,
)


class PushedSpring(Fake):
    """force = k (w(t) - give), w(t) = sin(t)."""

    inputs = ("give",)
    outputs = ("force",)

    def __init__(self, name, stiffness):
        super().__init__(name)
        self.stiffness = stiffness

    def initial_outputs(self, values):
        return [self.stiffness * (np.sin(self.time) - values[0])]

    def advance(self, over):
        return [self.stiffness * (np.sin(over.time + over.step_size) - over.end[0])]


class Compliance(Fake):
    """give = D force."""

    inputs = ("force",)
    outputs = ("give",)

    def __init__(self, name, compliance):
        super().__init__(name)
        self.compliance = compliance

    def initial_outputs(self, values):
        return [self.compliance * values[0]]

    def advance(self, over):
        return [self.compliance * over.end[0]]


def run(gain, *, start=0.5, **settings):
    system = System(
        [PushedSpring("spring", gain), Compliance("support", 1.0)],
        [
            Connection(source="spring.force", target="support.force"),
            Connection(source="support.give", target="spring.give"),
        ],
    )
    recorder = Recorder(["support.give"])
    chosen = MasterSettings(tolerance=None, fixed_step=0.01, **settings)
    outcome = Master(system, chosen, observers=[recorder]).run(start, start + 1.0)
    exact = gain / (1.0 + gain) * np.sin(recorder.time)
    return outcome, np.abs(recorder["support.give"] - exact)


ladder = [0.3, 0.9, 1.05, 1.5, 4.5]


@pytest.mark.parametrize("gain", ladder)
def test_newton_solves_the_loop_whatever_its_gain(gain):
    outcome, error = run(gain)
    # Residual tolerance 1e-7 on unknowns of order one; the initial values are settled to 1e-10.
    assert error.max() < 1e-7
    assert error[0] < 1e-10
    # A linear loop costs one Jacobian, then two sweeps a step at most.
    assert outcome.statistics.iterations <= 2 * outcome.statistics.accepted + 1


@pytest.mark.parametrize(("gain", "warnings"), [(0.3, 0), (0.9, 1)])
def test_held_gauss_seidel_follows_a_loop_with_a_gain_below_one(gain, warnings):
    outcome, error = run(gain, algorithm="gauss_seidel", extrapolate=False)
    # Each step brings the change of w once more, damped by the gain: sum of gain^n.
    assert error.max() < 2.0 * 0.01 * gain / (1.0 - gain)
    assert len(outcome.warnings) == warnings
    for warning in outcome.warnings:
        assert "support.give has a gain of 0.9 over a step of 0.01 s" in warning


@pytest.mark.parametrize("algorithm", ["gauss_seidel", "jacobi"])
@pytest.mark.parametrize("gain", [1.05, 1.5, 4.5])
def test_explicit_algorithms_are_refused_from_a_gain_of_one_on(gain, algorithm):
    # Jacobi takes two steps for one way through the loop.
    found = gain if algorithm == "gauss_seidel" else np.sqrt(gain)
    message = rf"support\.give has a gain of {found:.3g} over a step .*; use the algorithm newton"
    with pytest.raises(LoopGainError, match=message):
        run(gain, algorithm=algorithm, extrapolate=False)


@pytest.mark.parametrize("gain", [0.3, 0.35, 0.9])
def test_extrapolated_values_run_away_from_a_gain_of_a_third_on(gain):
    """z <- -g (2 z - z_before) has the roots -g -+ sqrt(g^2 + g), below 1 for g < 1/3."""
    if gain < 1.0 / 3.0:
        outcome, error = run(gain, algorithm="gauss_seidel")
        assert outcome.warnings == ()
        # Extrapolation misses sin(t) by h^2, and a transient decays from there.
        assert error[20:].max() < 1e-3
    else:
        growth = gain + np.sqrt(gain**2 + gain)
        with pytest.raises(LoopGainError, match=rf"by {growth:.3g} with every step.*hold"):
            run(gain, algorithm="gauss_seidel")


@pytest.mark.parametrize("gain", [1.5, 4.5])
@pytest.mark.parametrize("algorithm", ["gauss_seidel", "jacobi"])
def test_a_loop_that_was_not_measured_is_caught_on_the_way(gain, algorithm):
    with pytest.raises(DivergenceError, match=r"support\.give|spring\.force") as caught:
        run(gain, algorithm=algorithm, extrapolate=False, check_rollback=False)
    assert "use the algorithm newton" in str(caught.value)


def test_a_loop_without_a_single_solution_is_refused_in_words():
    with pytest.raises(
        InitialisationError, match=r"loop through support\.give has no single solution"
    ):
        run(-1.0)
