"""Every cause of rejection, counted, and what a rejection must leave behind: nothing."""

from functools import partial
from math import inf, nan

import numpy as np
import pytest
from fake_participants import Answering, Linear, discard, drop, oscillators

from orchestrator import (
    Connection,
    ErrorControl,
    Master,
    MasterSettings,
    ParticipantError,
    Recorder,
    RunError,
    Status,
    StatusKind,
    StepTooSmallError,
    System,
)
from orchestrator.decision import Cause
from tests.throwing import Throwing


def controller():
    return ErrorControl(initial_step=1e-4, min_step=1e-9, max_step=0.02)


@pytest.mark.parametrize(
    ("build", "events", "tolerance"),
    [
        (oscillators, (), 1e-3),
        (drop, ("ball.gap",), 1e-3),
        # A Hertzian spring and large steps: every step teaches the Jacobian something.
        (partial(drop, stiffness=1e5, power=1.5), ("ball.gap",), 0.3),
    ],
)
def test_attempts_thrown_away_at_random_leave_no_trace(build, events, tolerance):
    settings = MasterSettings(tolerance=tolerance, coupling_tolerance=1e-11)
    stop = 0.5
    plain, disturbed = Recorder(), Recorder()
    Master(build(), settings, controller=controller(), events=events, observers=[plain]).run(
        0.0, stop
    )
    throwing = Throwing(controller(), 0.3, seed=1)
    outcome = Master(
        build(), settings, controller=throwing, events=events, observers=[disturbed]
    ).run(0.0, stop)
    attempts = outcome.step_log.size
    assert throwing.thrown == pytest.approx(0.3 * attempts, rel=0.2)
    assert plain.time.tobytes() == disturbed.time.tobytes()
    assert plain.values.tobytes() == disturbed.values.tobytes()


def chain(script, **options):
    """Imposes nothing on `answering`, whose input stays 1."""
    source = Linear(
        "source",
        inputs=[],
        outputs=["y"],
        A=np.zeros((1, 1)),
        B=np.zeros((1, 0)),
        C=[[1.0]],
        D=np.zeros((1, 0)),
        x0=[1.0],
    )
    answering = Answering("answering", script, **options)
    return System([source, answering], [Connection(source="source.y", target="answering.u")])


def run(system, **settings):
    recorder = Recorder(["answering.y"])
    outcome = Master(system, MasterSettings(**settings), observers=[recorder]).run(0.0, 1.0)
    return outcome, recorder


def test_discarded_steps_are_repeated_in_halves():
    def script(_time, step_size):
        return discard() if step_size > 0.03 else None

    outcome, recorder = run(
        chain(script), tolerance=None, fixed_step=0.1, min_step=0.01, algorithm="jacobi"
    )
    # Each tenth is tried whole, then half (0.05), then a quarter (0.025); the next wish is the
    # rest of the tenth again: 0.075 and its half 0.0375 fail before 0.01875, and so on.
    assert outcome.statistics.rejected["discard"] == np.sum(outcome.step_log["cause"] == 4)
    assert outcome.statistics.rejected["discard"] >= 20
    assert recorder["answering.y"][-1] == pytest.approx(1.0, abs=1e-14)
    accepted = outcome.step_log[outcome.step_log["cause"] == 0]
    assert accepted["step_size"].max() <= 0.03
    assert outcome.end_time == 1.0


def test_a_discard_with_a_last_successful_time_is_repeated_up_to_there():
    def script(time, step_size):
        if time < 0.5 < time + step_size - 1e-12:
            return discard(until=0.5)
        return None

    outcome, recorder = run(
        chain(script), tolerance=None, fixed_step=0.8, min_step=0.01, algorithm="jacobi"
    )
    assert outcome.statistics.rejected["discard"] == 1
    assert recorder.time == pytest.approx([0.0, 0.5, 0.8, 1.0], abs=1e-15)


@pytest.mark.parametrize("value", [nan, inf, -inf])
def test_values_that_are_not_finite_are_invalid(value):
    def script(_time, step_size):
        return value if step_size > 0.06 else None

    outcome, recorder = run(
        chain(script), tolerance=None, fixed_step=0.1, min_step=0.01, algorithm="jacobi"
    )
    assert outcome.statistics.rejected["invalid"] == 10
    assert np.isfinite(recorder["answering.y"]).all()


def test_values_that_stay_not_finite_end_the_run_in_words():
    with pytest.raises(
        StepTooSmallError, match=r"answering: its value of y is not finite at t = 0"
    ):
        run(chain(lambda _t, _h: nan), tolerance=1e-3)


def test_an_error_is_forgiven_once():
    failing = iter([True])

    def script(time, _step_size):
        if time > 0.4 and next(failing, False):
            return Status(StatusKind.ERROR, "the step ended with fmi2Error")
        return None

    outcome, recorder = run(
        chain(script), tolerance=None, fixed_step=0.1, min_step=0.01, algorithm="jacobi"
    )
    assert outcome.statistics.rejected["invalid"] == 1
    assert recorder["answering.y"][-1] == pytest.approx(1.0, abs=1e-14)


def test_an_error_is_not_forgiven_twice():
    def script(time, _step_size):
        return Status(StatusKind.ERROR, "the step ended with fmi2Error") if time > 0.35 else None

    with pytest.raises(ParticipantError, match=r"answering: .*fmi2Error at t = 0\.4 s") as caught:
        run(chain(script), tolerance=None, fixed_step=0.1, min_step=0.01, algorithm="jacobi")
    assert caught.value.inputs == {"u": 1.0}
    assert caught.value.step_size == 0.05


def test_fatal_ends_the_run_at_once_and_the_dead_are_left_alone():
    def script(time, _step_size):
        return Status(StatusKind.FATAL, "the step ended with fmi2Fatal") if time > 0.35 else None

    system = chain(script)
    with pytest.raises(ParticipantError, match=r"answering: .*fmi2Fatal at t = 0\.4 s.*u = 1"):
        run(system, tolerance=None, fixed_step=0.1)
    for participant in system.participants:
        assert participant.calls[-1] == "free"
        assert "terminate" not in participant.calls


def test_the_smallest_step_is_the_end_and_the_error_names_it_all():
    with pytest.raises(StepTooSmallError) as caught:
        run(chain(lambda _t, _h: discard()), tolerance=1e-3, min_step=1e-3, max_step=0.1)
    message = str(caught.value)
    for part in ("answering", "fmi2Discard", "t = 0 s", "0.001 s", "u = 1"):
        assert part in message


def test_without_saved_states_a_failure_ends_the_run_with_the_remedy():
    with pytest.raises(RunError, match=r"no states are saved .* unless min_step is given"):
        run(chain(lambda _t, _h: discard()), tolerance=None, fixed_step=0.1, algorithm="jacobi")


def test_a_jump_is_refused_and_named():
    def script(time, step_size):
        return 1.0 + time + step_size if time + step_size > 0.5 else None

    jumping = chain(script)
    sink = Answering("sink", lambda _t, _h: None)
    system = System(
        [*jumping.participants, sink],
        [*jumping.connections, Connection(source="answering.y", target="sink.u")],
    )
    with pytest.raises(StepTooSmallError, match=r"answering\.y differ .* as an event"):
        run(system, tolerance=1e-3, initial_step=0.01, min_step=1e-6)


def test_rejections_in_a_row_are_limited():
    stubborn = Throwing(controller(), 2.0, seed=1)
    with pytest.raises(RunError, match=r"8 attempts in a row were rejected at t = 0 s.*error"):
        Master(
            oscillators(), MasterSettings(tolerance=1e-3, max_rejections=7), controller=stubborn
        ).run(0.0, 1.0)


def test_every_attempt_is_a_row_of_the_step_log():
    settings = MasterSettings(tolerance=1e-2, max_step=0.02, initial_step=0.02)
    outcome = Master(drop(), settings, events=["ball.gap"]).run(0.0, 0.5)
    log, counts = outcome.step_log, outcome.statistics
    assert log["iterations"].sum() == counts.iterations
    assert np.sum(log["cause"] == 0) == counts.accepted
    for cause in Cause:
        assert np.sum(log["cause"] == cause) == counts.rejected[cause.name.lower()]
    assert log.size == counts.accepted + sum(counts.rejected.values())
    assert counts.rejected["error"] > 0
    assert counts.rejected["event"] > 0
    accepted = log[log["cause"] == 0]
    assert accepted["time"][0] == 0.0
    assert np.diff(accepted["time"]) == pytest.approx(accepted["step_size"][:-1], abs=1e-14)
    known = accepted[np.isfinite(accepted["error_norm"])]
    assert known["error_norm"].max() <= 1.0
    assert accepted["residual_norm"].max() <= settings.coupling_tolerance


def test_saved_states_are_released():
    system = drop()
    settings = MasterSettings(tolerance=1e-2, max_step=0.02, initial_step=0.02)
    Master(system, settings, events=["ball.gap"]).run(0.0, 0.5)
    assert [participant.alive for participant in system.participants] == [0, 0]
