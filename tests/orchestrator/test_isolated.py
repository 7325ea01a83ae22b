"""FMUs in processes of their own: the same results, and crashes and hangs that are survived."""

import os
import time
from math import cos

import numpy as np
import pytest
from fake_participants import Spring

from orchestrator import (
    Connection,
    FmuError,
    FmuParticipant,
    IsolatedParticipant,
    Master,
    MasterSettings,
    ParticipantError,
    Recorder,
    RollbackError,
    SettingsError,
    StatusKind,
    StepTooSmallError,
    System,
)


def run(path, *, kind=IsolatedParticipant, start_values=None, options=None, **settings):
    mass = kind(path, name="mass", start_values=start_values, **(options or {}))
    spring = Spring("spring", lambda x: -100.0 * x, details={"force": {"nominal": 100.0}})
    wires = [
        Connection(source="mass.x", target="spring.displacement"),
        Connection(source="spring.force", target="mass.force"),
    ]
    recorder = Recorder()
    chosen = MasterSettings(**{"tolerance": None, "fixed_step": 0.01, **settings})
    outcome = Master(System([mass, spring], wires), chosen, observers=[recorder]).run(0.0, 1.0)
    return mass, outcome, recorder


@pytest.mark.parametrize(
    "settings",
    [
        {},
        {"tolerance": 1e-3, "fixed_step": None, "max_step": 0.05},
        {"algorithm": "gauss_seidel"},
    ],
    ids=["fixed", "error control", "explicit"],
)
def test_results_are_the_same_bit_for_bit(fmu, settings):
    _, _, inside = run(fmu, kind=FmuParticipant, **settings)
    _, _, outside = run(fmu, start_values={"label": "Räder"}, **settings)
    assert inside.time.tobytes() == outside.time.tobytes()
    assert inside.values.tobytes() == outside.values.tobytes()


ends = {
    5: "was ended by SIGABRT",
    6: "was ended by SIGSEGV",
    7: "ended by itself with exit code 7",
}


@pytest.mark.parametrize("trouble", ends)
def test_a_crash_ends_the_run_in_one_sentence(fmu, trouble):
    message = (
        rf"^mass: its process {ends[trouble]} in the step, and {ends[trouble]} when that was "
        r"repeated in a new one at t = 0\.51 s over a step of 0\.01 s with force = \S+\.$"
    )
    with pytest.raises(ParticipantError, match=message) as caught:
        run(fmu, start_values={"trouble": trouble})
    assert list(caught.value.inputs) == ["force"]


def test_a_hang_ends_the_run_within_the_time_out(fmu):
    began = time.perf_counter()
    with pytest.raises(ParticipantError, match=r"^mass: .* no answer within 6 s and .* t = 0\.51"):
        run(fmu, start_values={"trouble": 8}, options={"timeout": 6.0})
    # The time-out, once, and what starting the process and the steps before take.
    assert time.perf_counter() - began < 20.0


@pytest.mark.parametrize(
    "settings",
    [
        {},
        {"fixed_step": 1e-3},
        {"fixed_step": 1e-3, "algorithm": "gauss_seidel"},
        {"tolerance": 1e-3, "fixed_step": None, "max_step": 0.05},
    ],
    ids=["newton", "many steps", "explicit", "error control"],
)
def test_after_one_crash_the_run_goes_on_bit_for_bit(fmu, tmp_path, settings):
    _, _, plain = run(fmu, kind=FmuParticipant, **settings)
    values = {"trouble": 6, "label": str(tmp_path / "fuse")}
    mass, outcome, resumed = run(fmu, start_values=values, **settings)
    assert outcome.finished
    assert plain.time.tobytes() == resumed.time.tobytes()
    assert plain.values.tobytes() == resumed.values.tobytes()
    (incident,) = mass.incidents
    assert "mass: its process was ended by SIGSEGV in the step at t = 0.5" in incident
    steps = int(incident.rpartition("from there, ")[2].split()[0])
    assert 0 <= steps <= 200


def test_values_that_are_not_finite_are_named(fmu):
    with pytest.raises(StepTooSmallError, match=r"mass: its value of x is not finite at t = 0\.51"):
        run(fmu, start_values={"trouble": 9}, min_step=1e-3)


def test_discards_deaths_and_failing_starts_are_the_same(fmu):
    _, outcome, recorder = run(fmu, start_values={"trouble": 1}, fixed_step=0.02, min_step=0.001)
    assert outcome.statistics.rejected["discard"] == 50
    assert recorder["mass.x"][-1] == pytest.approx(cos(10.0), abs=3e-3)
    with pytest.raises(ParticipantError, match=r"^mass: the step ended with fmi2Fatal .*axle"):
        run(fmu, start_values={"trouble": 2})
    with pytest.raises(ParticipantError, match=r"^mass: fmi2ExitInit.*fmi2Fatal; .*100 % sure"):
        run(fmu, start_values={"trouble": 3})
    with pytest.raises(RollbackError, match=r"^mass claims to restore .*: x after a step of"):
        run(fmu, start_values={"trouble": 4})


def test_wrong_input_is_refused_at_once(fmu, tmp_path):
    with pytest.raises(FmuError, match="no such FMU file"):
        IsolatedParticipant(tmp_path / "nothing.fmu")
    with pytest.raises(FmuError, match="perhaps 'mass' is meant"):
        IsolatedParticipant(fmu, start_values={"mas": 1.0})
    with pytest.raises(SettingsError, match="timeout = 0"):
        IsolatedParticipant(fmu, timeout=0.0)


@pytest.fixture
def mass(fmu):
    participant = IsolatedParticipant(fmu)
    participant.bind(inputs=["force"], outputs=["x"], observed=["steps"], input_shape="linear")
    participant.instantiate()
    participant.enter_initialisation(start_time=0.0, stop_time=1.0, tolerance=None)
    participant.exit_initialisation()
    yield participant
    participant.free()
    participant.free()


def test_states_can_be_serialised(mass):
    state = mass.save()
    data = mass.serialise(state)
    mass.release(state)
    results = []
    for _ in range(2):
        copy = mass.deserialise(data)
        mass.restore(copy)
        mass.release(copy)
        mass.set_inputs(np.array([2.0]))
        mass.step(0.0, 0.1)
        out = np.empty(1)
        mass.get_outputs(out)
        results.append(out.tobytes())
    assert results[0] == results[1]


def test_a_process_killed_from_outside_between_steps_is_replaced(mass):
    mass.set_inputs(np.array([2.0]))
    mass.step(0.0, 0.1)
    mass._process._worker._process.kill()
    mass._process._worker._process.wait()
    mass.step(0.1, 0.1)
    observed = np.empty(1)
    mass.get_observed(observed)
    assert observed[0] == 2.0
    assert "SIGKILL" in mass.incidents[0]


def test_a_state_of_a_process_that_is_gone_can_still_be_serialised(mass):
    mass.set_inputs(np.array([2.0]))
    mass.step(0.0, 0.1)
    state = mass.save()
    data = mass.serialise(state)
    mass.free()
    assert mass.serialise(state) == data
    assert mass.process is None


def test_nothing_is_left_of_the_process(mass):
    process = mass._process._worker._process.pid
    mass.free()
    with pytest.raises(ProcessLookupError):
        os.kill(process, 0)
    assert mass.step(0.0, 0.1).kind is StatusKind.FATAL


def test_neither_saved_states_nor_the_way_to_them_pile_up(mass):
    for n in range(1000):
        state = mass.save()
        mass.set_inputs(np.array([1.0]))
        mass.step(0.01 * n, 0.01)
        mass.restore(state)
        mass.set_inputs(np.array([2.0]))
        mass.step(0.01 * n, 0.01)
        mass.release(state)
    point, length = mass._process.journal._point, 0
    while point.before is not None:
        point, length = point.before, length + 1
    assert length <= 2 * 100
    assert mass._process.journal._states == {}
