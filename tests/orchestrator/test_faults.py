"""Every fault ends with the right answer, or one sentence naming participant, time, cause."""

import gc
import sys
import tracemalloc

import numpy as np
import pytest
from fake_participants import Answering, Fake, Linear, discard, drop, oscillators, oscillators_exact
from mass_fmu import build

from orchestrator import (
    Cause,
    FmuParticipant,
    Master,
    MasterSettings,
    ParticipantError,
    Recorder,
    Reject,
    Status,
    StatusKind,
    StepTooSmallError,
    System,
)
from orchestrator.stage import Stage


def failing_first(kind, *, times):
    """Two masses, the second of which fails at t = 1 that many times."""
    system = oscillators()
    second = system.participants[1]
    left, plain = [kind] * times, second.advance

    def advance(over):
        if over.time > 0.995 and left:
            return Status(left.pop(), f"the step ended with fmi2{kind.name.title()}")
        return plain(over)

    second.advance = advance
    return system


def end_of(system, **settings):
    recorder = Recorder(["first.displacement"])
    chosen = MasterSettings(**{"tolerance": None, "fixed_step": 0.01, **settings})
    outcome = Master(system, chosen, observers=[recorder]).run(0.0, 2.0)
    return recorder["first.displacement"][-1], outcome


@pytest.mark.parametrize(
    "settings",
    [{}, {"min_step": 1e-3}, {"tolerance": 1e-4, "fixed_step": None, "max_step": 0.02}],
    ids=["fixed", "divided", "error control"],
)
def test_one_error_is_forgiven_in_every_kind_of_run(settings):
    end, outcome = end_of(failing_first(StatusKind.ERROR, times=1), **settings)
    assert outcome.statistics.rejected["invalid"] == 1
    assert end == pytest.approx(oscillators_exact(2.0)[0], abs=2e-3)


def test_one_error_leaves_no_trace_in_fixed_steps():
    assert end_of(failing_first(StatusKind.ERROR, times=1))[0] == end_of(oscillators())[0]


@pytest.mark.parametrize("settings", [{}, {"min_step": 1e-3}])
def test_a_second_error_ends_the_run(settings):
    with pytest.raises(ParticipantError, match=r"^second: the step ended with fmi2Error at t = 1 "):
        end_of(failing_first(StatusKind.ERROR, times=2), **settings)


def test_a_fatal_participant_is_not_touched_again():
    system = failing_first(StatusKind.FATAL, times=1)
    calls = []
    second = system.participants[1]
    plain = second.advance

    def watched(over):
        answer = plain(over)
        if isinstance(answer, Status):
            for name in ("set_inputs", "get_outputs", "get_observed", "step", "save", "restore"):
                setattr(second, name, lambda *_, name=name: calls.append(name))
            second.terminate = lambda: calls.append("terminate")
        return answer

    second.advance = watched
    with pytest.raises(ParticipantError, match=r"^second: the step ended with fmi2Fatal at t = 1 "):
        end_of(system)
    assert calls == []
    assert second.calls[-1] == "free"


def test_a_discard_that_never_ends_names_participant_and_time():
    sink = Answering("sink", lambda time, _h: discard() if time > 0.505 else None)
    settings = MasterSettings(tolerance=None, fixed_step=0.01, min_step=1e-4)
    with pytest.raises(StepTooSmallError, match=r"sink: the step ended with fmi2Discard at t = 0"):
        Master(System([sink], []), settings).run(0.0, 1.0)


# rollback is what all of this rests on


def drop_with_rejections():
    recorder = Recorder(["ball.displacement"])
    settings = MasterSettings(tolerance=1e-3, initial_step=1e-3, check_rollback=False)
    Master(drop(), settings, events=["ball.gap"], observers=[recorder]).run(0.0, 0.5)
    return recorder


def test_without_going_back_nothing_here_would_be_right(monkeypatch):
    """A mutation: if `restore` does nothing, what rests on it comes out wrong or not at all."""
    exact = oscillators_exact(2.0)[0]
    assert drop_with_rejections().time[-1] == 0.5
    assert end_of(oscillators(), check_rollback=False)[0] == pytest.approx(exact, abs=2e-3)
    monkeypatch.setattr(Fake, "restore", lambda _self, _state: None)
    with pytest.raises(StepTooSmallError, match="did not converge"):
        drop_with_rejections()
    with pytest.raises(StepTooSmallError, match="did not converge"):
        end_of(oscillators(), check_rollback=False)


def test_a_stage_that_does_not_go_back_is_found_by_the_start_up_check(monkeypatch):
    def forgetful(stage):
        stage._moved = False

    assert end_of(oscillators())[1].finished
    monkeypatch.setattr(Fake, "restore", lambda _self, _state: None)
    monkeypatch.setattr(Stage, "go_back", forgetful)
    with pytest.raises(Exception, match="first claims to restore saved states but does not"):
        end_of(oscillators())


# memory


class Counter(Linear):
    """Counts how many of its states are alive at most."""

    most = 0

    def save(self):
        state = super().save()
        Counter.most = max(Counter.most, self.alive)
        return state


def integrator(kind):
    return kind("mass", inputs=[], outputs=["x"], A=[[0.0]], B=np.zeros((1, 0)), C=[[1.0]],
                D=np.zeros((1, 0)), x0=[1.0])  # fmt: skip


def grown_by(run):
    """Return what a run of twice the length holds more than one of the single length [bytes]."""
    held = []
    for times in (1, 2):
        gc.collect()
        tracemalloc.start()
        run(times)
        gc.collect()
        held.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    return held[1] - held[0]


@pytest.mark.parametrize("steps", [4_096, pytest.param(40_960, marks=pytest.mark.slow)])
def test_states_do_not_pile_up(steps):
    """Only the step log grows, by 37 bytes an attempt, joined to one array in the end."""
    settings = MasterSettings(tolerance=None, fixed_step=1e-3, min_step=1e-4)

    def run(times):
        Master(System([integrator(Counter)], []), settings).run(0.0, 1e-3 * steps * times)

    run(1)
    Counter.most = 0
    assert grown_by(run) < 2 * 37 * steps + 100_000
    # The state of the accepted point, and the next one before that is released.
    assert Counter.most == 2


class Census(Recorder):
    """Counts the states of an FMU that are alive at every accepted point."""

    def __init__(self, module):
        super().__init__([])
        self.module = module
        self.most = 0

    def accepted(self, time, values):
        super().accepted(time, values)
        self.most = max(self.most, sys.modules[self.module].State.alive)


@pytest.mark.parametrize("steps", [2_000, pytest.param(100_000, marks=pytest.mark.slow)])
def test_states_of_an_fmu_do_not_pile_up(tmp_path, steps):
    name = f"OrchestratorTestLeak{steps}"
    mass = FmuParticipant(build(tmp_path, name), name="mass")
    census = Census(f"{name.lower()}_slave")
    settings = MasterSettings(tolerance=None, fixed_step=1e-3, min_step=1e-4)
    # Every other attempt is thrown away.
    throwing = EveryOther(settings.make_controller(1.0))
    outcome = Master(System([mass], []), settings, controller=throwing, observers=[census]).run(
        0.0, 1e-3 * steps
    )
    assert outcome.statistics.accepted == steps
    assert outcome.statistics.rejected["error"] == steps
    assert census.most == 1


class EveryOther:
    """Throws every other attempt away and asks for the same step again."""

    def __init__(self, inner):
        self.inner = inner
        self.thrown = False

    def __getattr__(self, name):
        return getattr(self.inner, name)

    def decide(self, candidate):
        self.thrown = not self.thrown
        if self.thrown:
            return Reject(Cause.ERROR, candidate.step_size)
        return self.inner.decide(candidate)
