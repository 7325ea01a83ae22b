"""The gain of loops is measured before an explicit run, and leaves no trace."""

import numpy as np
import pytest
from fake_participants import Linear, drop, oscillators

from orchestrator import LoopGainError, Master, MasterSettings, Recorder, RollbackError
from orchestrator.block import tear
from orchestrator.exchange import Exchange
from orchestrator.loop_gain import estimate_loop_gains, spectral_radius


def ready(system, *, input_shape="linear"):
    exchange = Exchange(system, indicators=(), observed=(), input_shape=input_shape)
    for stage in exchange.stages:
        stage.participant.instantiate()
        stage.participant.enter_initialisation(start_time=0.0, stop_time=1.0, tolerance=None)
        stage.read_outputs()
        stage.participant.exit_initialisation()
    return exchange


def test_the_gain_of_two_masses_is_that_of_the_closed_form():
    exchange = ready(oscillators(kc=100.0, dc=0.0, k=0.0))
    (block,) = tear(exchange, everything=False, last=None)
    h = 0.01
    (found,) = estimate_loop_gains(exchange, [block], 0.0, h)
    # A force that rises linearly from zero moves a free mass by h^2/6. The force of the spring
    # is that displacement times its stiffness, less what its own mass gives way (of order h^4).
    assert found.gain == pytest.approx(100.0 * h**2 / 6.0, rel=1e-2)
    assert found.names == block.names


def test_states_inputs_and_outputs_are_left_bit_for_bit():
    system = oscillators()
    exchange = ready(system)
    before = [
        (p.state.tobytes(), p.values.tobytes(), p.result.tobytes(), p.held.tobytes(), p.time)
        for p in system.participants
    ]
    flat = exchange.inputs.tobytes(), exchange.outputs.tobytes()
    blocks = tear(exchange, everything=True, last=None)
    estimate_loop_gains(exchange, blocks, 0.0, 0.1)
    assert before == [
        (p.state.tobytes(), p.values.tobytes(), p.result.tobytes(), p.held.tobytes(), p.time)
        for p in system.participants
    ]
    assert flat == (exchange.inputs.tobytes(), exchange.outputs.tobytes())
    assert [p.alive for p in system.participants] == [0, 0]


@pytest.mark.parametrize("algorithm", ["jacobi", "gauss_seidel"])
def test_a_measured_run_is_the_same_as_one_that_was_not_measured(algorithm):
    histories = []
    for check in (True, False):
        recorder = Recorder()
        settings = MasterSettings(
            tolerance=None, fixed_step=0.01, algorithm=algorithm, check_rollback=check
        )
        Master(oscillators(), settings, observers=[recorder]).run(0.0, 1.0)
        histories.append(recorder.values.tobytes())
    assert histories[0] == histories[1]


def test_a_step_that_is_too_long_for_the_coupling_is_refused():
    settings = MasterSettings(tolerance=None, fixed_step=1.0, algorithm="gauss_seidel")
    with pytest.raises(
        LoopGainError, match=r"loop through .* has a gain of .* over a step of 1 s, which"
    ):
        Master(oscillators(), settings).run(0.0, 2.0)
    newton = MasterSettings(tolerance=None, fixed_step=1.0)
    assert Master(oscillators(), newton).run(0.0, 2.0).finished


def test_what_cannot_be_measured_is_said():
    system = oscillators(kc=10.0, dc=0.5)
    system.participants[0].can_save_state = False
    settings = MasterSettings(tolerance=None, fixed_step=0.01, algorithm="jacobi")
    (warning,) = Master(system, settings).run(0.0, 0.1).warnings
    assert "is unknown, because first cannot save the state" in warning


def test_a_liar_is_named_before_it_can_spoil_an_explicit_run():
    class Liar(Linear):
        def restore(self, state):
            velocity = self.state[1]
            super().restore(state)
            self.state[1] = velocity

    system = oscillators()
    system.participants[0].__class__ = Liar
    settings = MasterSettings(tolerance=None, fixed_step=0.01, algorithm="jacobi")
    with pytest.raises(RollbackError, match="first claims to restore"):
        Master(system, settings).run(0.0, 0.1)


def test_contact_that_is_not_there_yet_has_no_gain():
    exchange = ready(drop())
    blocks = tear(exchange, everything=False, last=None)
    assert [item.gain for item in estimate_loop_gains(exchange, blocks, 0.0, 1e-3)] == [0.0]


def test_the_spectral_radius_counts_complex_eigenvalues():
    assert spectral_radius(np.array([[0.0, -4.0], [1.0, 0.0]])) == pytest.approx(2.0)
    assert spectral_radius(np.zeros((0, 0))) == 0.0
