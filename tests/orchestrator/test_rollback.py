"""Participants that cannot go back, and those that only say they can."""

import pytest
from fake_participants import (
    Answering,
    Linear,
    Spring,
    discard,
    drop,
    oscillators,
    oscillators_exact,
)

from orchestrator import (
    Connection,
    Master,
    MasterSettings,
    ParticipantError,
    Recorder,
    RollbackError,
    SettingsError,
    Status,
    StatusKind,
    System,
    WiringError,
)

soft = {"kc": 10.0, "dc": 0.5}


class PublishedOnly(Linear):
    """Restores what it shows and forgets its velocity."""

    def restore(self, state):
        velocity = self.state[1]
        super().restore(state)
        self.state[1] = velocity


def liar_and_spring(kind):
    liar = kind(
        "mass",
        inputs=["force"],
        outputs=["displacement"],
        A=[[0, 1], [0, 0]],
        B=[[0], [-1]],
        C=[[1, 0]],
        D=[[0]],
        x0=[1, 0],
    )
    spring = Spring("spring", lambda x: 10.0 * x)
    wires = [
        Connection(source="mass.displacement", target="spring.displacement"),
        Connection(source="spring.force", target="mass.force"),
    ]
    return System([liar, spring], wires)


def test_a_liar_is_named():
    settings = MasterSettings(tolerance=None, fixed_step=0.01)
    with pytest.raises(RollbackError, match=r"mass claims to restore .* displacement after a step"):
        Master(liar_and_spring(PublishedOnly), settings).run(0.0, 1.0)
    outcome = Master(liar_and_spring(Linear), settings).run(0.0, 1.0)
    assert outcome.finished


class HeldBack(Linear):
    """Forgets where its inputs on straight lines start."""

    def restore(self, state):
        held = self.held
        super().restore(state)
        self.held = held


def test_a_state_without_the_start_of_the_input_ramps_is_found():
    settings = MasterSettings(tolerance=None, fixed_step=0.01)
    with pytest.raises(RollbackError, match="mass claims"):
        Master(liar_and_spring(HeldBack), settings).run(0.0, 1.0)


def test_death_during_the_check_is_reported():
    dying = Answering("dying", lambda time, _h: Status(StatusKind.FATAL, "dead") if time else None)
    with pytest.raises(ParticipantError, match=r"dying: dead at t = 0\.01 s"):
        Master(
            System([dying], []), MasterSettings(tolerance=None, fixed_step=0.01, min_step=1e-3)
        ).run(0.0, 1.0)


def with_sink(**options):
    source = drop().participants[0]
    sink = Answering("sink", lambda _t, _h: None, can_save_state=False, **options)
    steps = []
    original = sink.advance

    def counting(over):
        steps.append((over.time, over.step_size, over.end[0]))
        return original(over)

    sink.advance = counting
    wires = [Connection(source="ball.displacement", target="sink.u")]
    return System([sink, source], wires), steps


def test_one_that_cannot_go_back_steps_last_and_once():
    system, steps = with_sink()
    settings = MasterSettings(tolerance=1e-3, initial_step=0.05, max_step=0.05)
    outcome = Master(system, settings, events=["ball.gap"]).run(0.0, 0.4)
    log = outcome.step_log
    accepted = log[log["cause"] == 0]
    assert log.size > accepted.size
    assert [step[0] for step in steps] == accepted["time"].tolist()
    assert [step[1] for step in steps] == accepted["step_size"].tolist()
    # Its input is what the ball had at the end of the accepted step: free fall.
    ends = accepted["time"] + accepted["step_size"]
    assert [step[2] for step in steps] == pytest.approx(-0.1 + 5.0 * ends**2, abs=1e-12)


def test_its_outputs_cannot_be_indicators():
    system, _ = with_sink()
    with pytest.raises(WiringError, match=r"sink\.y cannot be an event indicator"):
        Master(system, MasterSettings(tolerance=1e-3), events=["sink.y"]).run(0.0, 1.0)


def test_newton_refuses_one_that_drives_others():
    system = oscillators()
    system.participants[0].can_save_state = False
    with pytest.raises(RollbackError, match=r"first cannot save its state.*explicit algorithm"):
        Master(system, MasterSettings(tolerance=None, fixed_step=0.01)).run(0.0, 1.0)


def test_explicit_error_control_refuses_it_too():
    system = oscillators()
    system.participants[0].can_save_state = False
    with pytest.raises(RollbackError, match="explicit algorithm with a fixed step"):
        Master(system, MasterSettings(tolerance=1e-3, algorithm="jacobi")).run(0.0, 1.0)


def test_explicit_fixed_steps_take_it_once_within_a_loop():
    system = oscillators(**soft)
    first, second = system.participants
    first.can_save_state = False
    count = []
    plain_first, plain_second = first.advance, second.advance

    def counting(over):
        count.append(1)
        return plain_first(over)

    def discarding(over):
        if 1.0 < over.time + over.step_size < 1.1 and over.step_size > 0.004:
            return discard()
        return plain_second(over)

    first.advance, second.advance = counting, discarding
    recorder = Recorder(["first.displacement"])
    settings = MasterSettings(
        tolerance=None, fixed_step=0.005, min_step=0.001, algorithm="gauss_seidel"
    )
    outcome = Master(system, settings, observers=[recorder]).run(0.0, 2.0)
    assert outcome.statistics.rejected["discard"] > 10
    assert len(count) == outcome.statistics.accepted
    # Second order: about 1e-3 at 0.005, see the orders of the two masses.
    assert recorder["first.displacement"][-1] == pytest.approx(
        oscillators_exact(2.0, **soft)[0], abs=2e-3
    )


def test_two_that_cannot_go_back_are_refused():
    system = oscillators()
    for participant in system.participants:
        participant.can_save_state = False
    with pytest.raises(RollbackError, match="first and second cannot save their states"):
        Master(system, MasterSettings(tolerance=1e-3, algorithm="jacobi")).run(0.0, 1.0)
    explicit = MasterSettings(tolerance=None, fixed_step=0.01, algorithm="jacobi")
    assert Master(system, explicit).run(0.0, 1.0).finished


def test_steps_of_one_size_are_respected():
    system = oscillators()
    system.participants[1].can_vary_step = False
    with pytest.raises(SettingsError, match="second needs steps of one size"):
        Master(system, MasterSettings(tolerance=1e-3)).run(0.0, 1.0)
    outcome = Master(system, MasterSettings(tolerance=None, fixed_step=0.01)).run(0.0, 1.0)
    assert set(outcome.step_log["step_size"]) == {0.01}
