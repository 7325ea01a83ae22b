"""An FMU driven through FmuParticipant: results, rollback, faults."""

import sys
from math import cos

import numpy as np
import pytest
from fake_participants import Spring
from mass_fmu import build

from orchestrator import (
    OK,
    Connection,
    FmuParticipant,
    Master,
    MasterSettings,
    ParticipantError,
    Recorder,
    RollbackError,
    StatusKind,
    System,
    WiringError,
)


def oscillator(mass):
    spring = Spring("spring", lambda x: -100.0 * x, details={"force": {"nominal": 100.0}})
    return System(
        [mass, spring],
        [
            Connection(source=f"{mass.name}.x", target="spring.displacement"),
            Connection(source="spring.force", target=f"{mass.name}.force"),
        ],
    )


def run(path, *, names=None, start_values=None, **settings):
    mass = FmuParticipant(path, name="mass", start_values=start_values)
    recorder = Recorder(names)
    settings = {"tolerance": None, "fixed_step": 1e-3, **settings}
    master = Master(oscillator(mass), MasterSettings(**settings), observers=[recorder])
    return mass, master.run(0.0, 1.0), recorder


def test_an_fmu_oscillates_like_the_closed_form(fmu, unpacked):
    mass, outcome, recorder = run(fmu, start_values={"label": "Räder", "mass": 4.0})
    assert mass.input_shape == "linear"
    # Second order: the frequency of 5 rad/s is off by (5 h)^2 / 24 or so, relatively.
    assert recorder["mass.x"] == pytest.approx(np.cos(5.0 * recorder.time), abs=2e-5)
    assert recorder["mass.steps"].tolist() == list(range(1001))
    assert recorder["mass.moving"].tolist() == [0.0] + [1.0] * 1000
    assert outcome.statistics.iterations > outcome.statistics.accepted
    assert list(unpacked.iterdir()) == []


def test_error_control_and_rollback_work_with_an_fmu(fmu):
    _, outcome, recorder = run(fmu, tolerance=1e-3, fixed_step=None, max_step=0.05)
    assert recorder["mass.x"][-1] == pytest.approx(cos(10.0), abs=1e-3)
    # Rejected steps leave no trace: the counter of the FMU counts accepted ones.
    assert recorder["mass.steps"][-1] == outcome.statistics.accepted
    assert outcome.statistics.rejected["error"] > 0


def test_inputs_stay_held_when_the_user_wants_it(fmu):
    mass, _, held = run(fmu, start_values={"linear_inputs": False})
    assert mass.input_shape == "held"
    _, _, linear = run(fmu)
    error = [abs(recorder["mass.x"][-1] - cos(10.0)) for recorder in (held, linear)]
    # First against second order at h = 1e-3.
    assert error[0] > 50.0 * error[1]


def test_a_participant_can_run_again_with_other_inputs(fmu):
    mass = FmuParticipant(fmu, name="mass")
    shapes, ends = [], []
    for extrapolate in (True, False, True):
        settings = MasterSettings(
            tolerance=None, fixed_step=1e-3, algorithm="gauss_seidel", extrapolate=extrapolate
        )
        recorder = Recorder(["mass.x"])
        Master(oscillator(mass), settings, observers=[recorder]).run(0.0, 1.0)
        shapes.append(mass.input_shape)
        ends.append(recorder["mass.x"][-1])
    assert shapes == ["linear", "held", "linear"]
    assert ends[0] == ends[2] != ends[1]


def test_saved_states_are_freed(fmu):
    run(fmu, tolerance=1e-2, fixed_step=None, max_step=0.05)
    assert sys.modules["orchestratortestmass_slave"].State.alive == 0


def test_two_instances_do_not_disturb_each_other(fmu):
    def both(names):
        masses = [FmuParticipant(fmu, name=name) for name in names]
        springs = [Spring(f"s_{name}", lambda x: -100.0 * x) for name in names]
        wires = [
            wire
            for name in names
            for wire in (
                Connection(source=f"{name}.x", target=f"s_{name}.displacement"),
                Connection(source=f"s_{name}.force", target=f"{name}.force"),
            )
        ]
        recorder = Recorder([f"{names[0]}.x"])
        settings = MasterSettings(tolerance=None, fixed_step=0.01)
        Master(System([*masses, *springs], wires), settings, observers=[recorder]).run(0.0, 1.0)
        return recorder.values[:, 0]

    assert both(["a", "b"]).tobytes() == both(["a"]).tobytes()


def test_a_discarded_step_is_repeated_smaller(fmu):
    _, outcome, recorder = run(fmu, start_values={"trouble": 1}, fixed_step=0.02, min_step=0.001)
    assert outcome.statistics.rejected["discard"] == 50
    assert outcome.statistics.accepted == 100
    assert recorder["mass.steps"][-1] == 100
    assert recorder["mass.x"][-1] == pytest.approx(cos(10.0), abs=3e-3)


def test_a_dead_fmu_is_named_with_its_last_words_and_never_called_again(fmu, unpacked):
    message = (
        r"^mass: the step ended with fmi2Fatal at t = 0\.501 s over a step of 0\.001 s "
        r"with force = .*; it logged: \[fatal\] .*broken axle.*\.$"
    )
    with pytest.raises(ParticipantError, match=message) as caught:
        run(fmu, start_values={"trouble": 2})
    assert caught.value.time == pytest.approx(0.501)
    assert list(caught.value.inputs) == ["force"]
    assert list(unpacked.iterdir()) == []
    assert run(fmu)[1].finished


def test_a_failing_initialisation_is_named(fmu):
    with pytest.raises(ParticipantError, match=r"^mass: fmi2ExitInit.*fmi2Fatal; .*100 % sure"):
        run(fmu, start_values={"trouble": 3})


def test_an_fmu_that_only_claims_to_restore_is_named(fmu):
    with pytest.raises(RollbackError, match=r"^mass claims to restore .*: x after a step of"):
        run(fmu, start_values={"trouble": 4})


def test_an_fmu_without_states_steps_once_a_step(tmp_path):
    path = build(tmp_path, "OrchestratorTestPlain", canGetAndSetFMUstate=False)
    with pytest.raises(RollbackError, match=r"mass cannot save its state.*explicit algorithm"):
        run(path)
    _, outcome, recorder = run(path, algorithm="gauss_seidel")
    assert recorder["mass.steps"][-1] == outcome.statistics.accepted == 1000
    assert recorder["mass.x"][-1] == pytest.approx(cos(10.0), abs=1e-3)


def test_states_can_be_serialised(fmu):
    mass = FmuParticipant(fmu)
    mass.bind(inputs=["force"], outputs=["x"], observed=["v"], input_shape="linear")
    mass.instantiate()
    try:
        mass.enter_initialisation(start_time=0.0, stop_time=1.0, tolerance=None)
        mass.exit_initialisation()
        state = mass.save()
        data = mass.serialise(state)
        mass.release(state)
        results = []
        for _ in range(2):
            copy = mass.deserialise(data)
            mass.restore(copy)
            mass.release(copy)
            assert mass.set_inputs(np.array([2.0])) is OK
            assert mass.step(0.0, 0.1) is OK
            out = np.empty(1)
            assert mass.get_outputs(out) is OK
            results.append(out.copy())
    finally:
        mass.free()
        mass.free()
    assert results[0].tobytes() == results[1].tobytes()
    assert results[0][0] == pytest.approx(1.0 + 0.1**2 * 2.0 / 6.0, abs=1e-15)


def test_a_discard_is_a_value(fmu):
    mass = FmuParticipant(fmu, start_values={"trouble": 1})
    mass.bind(inputs=[], outputs=["x"], observed=[], input_shape="linear")
    mass.instantiate()
    try:
        mass.enter_initialisation(start_time=0.0, stop_time=1.0, tolerance=1e-3)
        mass.exit_initialisation()
        status = mass.step(0.0, 0.1)
        assert status.kind is StatusKind.DISCARD
        # pythonfmu reports the start of the step, which is no progress.
        assert status.last_successful_time is None
        assert mass.messages == ("[warning] a step of 0.100 s is too long",)
        mass.terminate()
    finally:
        mass.free()


def test_unknown_variables_of_connections_are_refused(fmu):
    mass = FmuParticipant(fmu)
    assert mass.name == "OrchestratorTestMass"
    with pytest.raises(WiringError, match=r"has no variable 'forces'; perhaps 'force' is meant"):
        System(
            [mass],
            [Connection(source="OrchestratorTestMass.x", target="OrchestratorTestMass.forces")],
        )


def test_an_fmu_that_says_nothing_of_its_dependences_is_not_guessed_at(fmu):
    mass = FmuParticipant(fmu)
    assert mass.dependencies == dict.fromkeys(("x", "steps", "v", "moving"))
    assert not mass.provides_directional_derivatives
