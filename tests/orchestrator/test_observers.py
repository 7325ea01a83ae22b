"""Observers see every accepted point; runs can be stopped from outside."""

import signal
import threading

import numpy as np
import pytest
from fake_participants import Answering, oscillators

from orchestrator import (
    Master,
    MasterSettings,
    Recorder,
    RunError,
    StopReason,
    System,
    Variable,
    WiringError,
)

fixed = MasterSettings(tolerance=None, fixed_step=0.01)


class Watching:
    """Calls a function at every accepted point."""

    def __init__(self, action):
        self.action = action
        self.ended = 0

    def choose(self, available):
        return [name for name in available if name.endswith("velocity")]

    def start(self, variables, log):
        self.names = list(variables)
        self.log = log
        self.seen = []

    def accepted(self, time, values):
        self.seen.append((self.log.attempts, self.log.accepted, self.log.step_size))
        self.action(time, dict(zip(self.names, values.tolist(), strict=True)))

    def finished(self):
        self.ended += 1


def test_a_recorder_keeps_all_outputs_by_default():
    recorder = Recorder()
    Master(oscillators(), fixed, observers=[recorder]).run(0.0, 1.0)
    assert list(recorder.variables) == [
        "first.displacement",
        "first.velocity",
        "second.force",
        "second.own_displacement",
    ]
    assert recorder.values.shape == (101, 4)
    assert recorder["first.displacement"][0] == 1.0
    assert recorder.time[[0, -1]].tolist() == [0.0, 1.0]


def test_two_recorders_keep_what_each_chose():
    one, other = Recorder(["second.force"]), Recorder(["second.force", "first.velocity"])
    Master(oscillators(), fixed, observers=[one, other]).run(0.0, 1.0)
    assert np.array_equal(one["second.force"], other["second.force"])
    assert other.values.shape == (101, 2)
    assert not np.array_equal(other["first.velocity"], other["second.force"])


def test_inputs_can_be_recorded():
    recorder = Recorder(["second.force", "first.force"])
    Master(oscillators(), fixed, observers=[recorder]).run(0.0, 1.0)
    # The residual of the coupling, 1e-7 of the nominal value of 100.
    assert recorder["first.force"] == pytest.approx(recorder["second.force"], abs=1e-5)


def test_histories_grow_as_needed():
    recorder = Recorder(["second.force"])
    Master(
        oscillators(), MasterSettings(tolerance=None, fixed_step=2e-4), observers=[recorder]
    ).run(0.0, 1.0)
    assert recorder.values.shape == (5001, 1)
    assert np.diff(recorder.time).min() > 0.0


def test_unknown_names_are_refused_before_anything_runs():
    system = oscillators()
    with pytest.raises(WiringError, match=r"perhaps 'force' is meant"):
        Master(system, fixed, observers=[Recorder(["second.forces"])]).run(0.0, 1.0)
    assert system.participants[0].calls == []
    recorder = Recorder(["second.force"])
    Master(system, fixed, observers=[recorder]).run(0.0, 0.1)
    with pytest.raises(WiringError, match=r"'second\.torque' was not recorded"):
        recorder["second.torque"]


def test_strings_cannot_be_recorded():
    labelled = Answering("labelled", lambda _t, _h: None)
    labelled.variables["label"] = Variable(name="label", type="String", causality="output")
    system = System([labelled], [])
    with pytest.raises(WiringError, match=r"labelled\.label is a String"):
        Master(system, fixed, observers=[Recorder(["labelled.label"])]).run(0.0, 1.0)
    recorder = Recorder()
    Master(system, fixed, observers=[recorder]).run(0.0, 1.0)
    assert list(recorder.variables) == ["labelled.y"]


def test_observers_can_follow_the_step_log():
    watching = Watching(lambda _time, _values: None)
    Master(oscillators(), fixed, observers=[watching]).run(0.0, 0.03)
    assert watching.names == ["first.velocity", "second.velocity"]
    assert watching.seen == [(0, 0, 0.0), (1, 1, 0.01), (2, 2, 0.01), (3, 3, 0.01)]


def test_ctrl_c_ends_the_run_after_the_step():
    def interrupt(time, _values):
        if time >= 0.5:
            signal.raise_signal(signal.SIGINT)

    system, recorder, watching = oscillators(), Recorder(), Watching(interrupt)
    handler = signal.getsignal(signal.SIGINT)
    outcome = Master(system, fixed, observers=[recorder, watching]).run(0.0, 1.0)
    assert outcome.reason is StopReason.INTERRUPTED
    assert not outcome.finished
    assert outcome.end_time == recorder.time[-1] == 0.5
    assert outcome.statistics.accepted == 50
    assert watching.ended == 1
    assert system.participants[0].calls[-2:] == ["terminate", "free"]
    assert signal.getsignal(signal.SIGINT) is handler


@pytest.fixture
def usual_ctrl_c():
    """Python's own handler, where a shell has started the tests in the background without it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("usual_ctrl_c")
def test_a_second_ctrl_c_breaks_into_the_step():
    system, recorder = oscillators(), Recorder()
    original = system.participants[1].advance

    def interrupted(over):
        if over.time >= 0.5:
            signal.raise_signal(signal.SIGINT)
            signal.raise_signal(signal.SIGINT)
        return original(over)

    system.participants[1].advance = interrupted
    outcome = Master(system, fixed, observers=[recorder]).run(0.0, 1.0)
    assert outcome.reason is StopReason.INTERRUPTED
    assert outcome.end_time == recorder.time[-1] == 0.5
    assert system.participants[0].calls[-1] == "free"
    assert "terminate" not in system.participants[0].calls


def test_other_threads_run_without_signals():
    outcomes = []
    master = Master(oscillators(), fixed)
    thread = threading.Thread(target=lambda: outcomes.append(master.run(0.0, 1.0)))
    thread.start()
    thread.join()
    assert outcomes[0].finished


def test_an_observer_that_fails_stops_the_run_and_participants_are_freed():
    def fail(time, _values):
        if time >= 0.5:
            raise OSError("disk full")

    system, watching = oscillators(), Watching(fail)
    with pytest.raises(OSError, match="disk full"):
        Master(system, fixed, observers=[watching]).run(0.0, 1.0)
    assert watching.ended == 1
    assert [participant.calls[-1] for participant in system.participants] == ["free", "free"]
    assert [participant.alive for participant in system.participants] == [0, 0]


@pytest.mark.parametrize(
    ("budget", "reason"),
    [
        ({"max_attempts": 7}, StopReason.STEP_BUDGET),
        ({"max_wall_time": 1e-9}, StopReason.TIME_BUDGET),
    ],
)
def test_budgets_end_the_run_early(budget, reason):
    settings = MasterSettings(tolerance=None, fixed_step=0.01, **budget)
    outcome = Master(oscillators(), settings).run(0.0, 1.0)
    assert outcome.reason is reason
    assert outcome.statistics.accepted == (7 if "max_attempts" in budget else 0)


def test_initial_values_that_are_not_finite_are_named():
    undefined = Answering("undefined", lambda _t, _h: None)
    undefined.initial_outputs = lambda _values: [float("nan")]
    with pytest.raises(RunError, match=r"undefined: its value of y is not finite at t = 0 s"):
        Master(System([undefined], []), fixed, observers=[Recorder()]).run(0.0, 1.0)
