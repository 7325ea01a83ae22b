"""A spring and a compliance in series close an algebraic loop of gain k D."""

import numpy as np
import pytest
from fake_participants import Fake

from orchestrator import Connection, InitialisationError, Master, MasterSettings, Recorder, System


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


@pytest.mark.parametrize("gain", ladder)
def test_held_gauss_seidel_is_stable_only_for_a_gain_below_one(gain):
    _, error = run(gain, algorithm="gauss_seidel", extrapolate=False)
    if gain < 1.0:
        # Each step brings the change of w once more, damped by the gain: sum of gain^n.
        assert error.max() < 2.0 * 0.01 * gain / (1.0 - gain)
    else:
        assert error[-1] > 0.5 * error[1] * gain**99


def test_a_loop_without_a_single_solution_is_refused_in_words():
    with pytest.raises(InitialisationError, match=r"support\.give became .* has no solution"):
        run(-1.0)
