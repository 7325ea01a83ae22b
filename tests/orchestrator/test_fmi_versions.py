"""FMUs in C of both versions: exact results, states, faults, early returns."""

import numpy as np
import pytest
from compiled_fmus import build
from fake_participants import Spring
from fmu_driving import read, started

from orchestrator import (
    OK,
    Connection,
    FmuParticipant,
    IsolatedParticipant,
    Master,
    MasterSettings,
    ParticipantError,
    Recorder,
    RollbackError,
    Status,
    StatusKind,
    StepTooSmallError,
    System,
    ZenoError,
    check_fmu,
)
from orchestrator.fmu.fmi3 import Fmi3Instance

both = pytest.mark.parametrize("fmi_version", [2, 3])


def fall(path, *, kind=FmuParticipant, trouble=0, **settings):
    """A mass alone, under a constant force, which is exact in every step."""
    mass = kind(path, name="mass", start_values={"trouble": trouble, "force": 2.0})
    recorder = Recorder()
    chosen = {"tolerance": None, "fixed_step": 0.02, "min_step": 1e-4, **settings}
    outcome = Master(System([mass], []), MasterSettings(**chosen), observers=[recorder]).run(0, 1)
    return outcome, recorder


exact_x, exact_v = 2.0, 2.0


@both
def test_a_step_is_exact_and_goes_back_bit_for_bit(compiled_fmu, fmi_version):
    path = compiled_fmu("mass", fmi_version)
    mass = FmuParticipant(path, start_values={"mass": 2.0})
    started(mass, inputs=["force"], outputs=["v", "x"], observed=["moving", "steps", "force"])
    try:
        assert mass.set_inputs(np.array([4.0])) is OK
        state = mass.save()
        assert mass.step(0.0, 0.5) is OK
        first = read(mass.get_outputs, 2)
        assert first == [1.0, 1.25]
        assert read(mass.get_observed, 3) == [1.0, 1.0, 4.0]
        assert mass.step(0.5, 0.5) is OK
        data = mass.serialise(state)
        mass.restore(state)
        mass.release(state)
        assert mass.step(0.0, 0.5) is OK
        assert read(mass.get_outputs, 2) == first
        again = mass.deserialise(data)
        mass.restore(again)
        mass.release(again)
        assert mass.step(0.0, 0.5) is OK
        assert read(mass.get_outputs, 2) == first
        mass.terminate()
    finally:
        mass.free()


@both
@pytest.mark.parametrize("kind", [FmuParticipant, IsolatedParticipant])
def test_claims_and_derivatives_of_the_feed_through(compiled_fmu, fmi_version, kind):
    mass = kind(compiled_fmu("mass", fmi_version), start_values={"mass": 4.0})
    assert mass.dependencies == {
        "x": frozenset(), "v": frozenset(), "a": frozenset({"force"}),
        "steps": frozenset(), "moving": frozenset(),
    }  # fmt: skip
    assert mass.provides_directional_derivatives
    started(mass, inputs=["force"], outputs=["x", "a"])
    try:
        out = np.full((2, 1), np.nan)
        assert mass.directional_derivatives(out) is OK
        assert out.tolist() == [[0.0], [0.25]]
    finally:
        mass.free()


@both
def test_a_run_is_the_same_in_a_process_of_its_own(compiled_fmu, fmi_version):
    path = compiled_fmu("mass", fmi_version)
    inside = fall(path)[1]
    outside = fall(path, kind=IsolatedParticipant)[1]
    assert inside.values.tobytes() == outside.values.tobytes()
    assert inside["mass.x"][-1] == pytest.approx(exact_x, abs=1e-14)
    assert inside["mass.v"][-1] == pytest.approx(exact_v, abs=1e-14)


@both
@pytest.mark.parametrize(("trouble", "size"), [(1, 0.01), (11, 0.01)])
def test_a_discarded_step_becomes_smaller(compiled_fmu, fmi_version, trouble, size):
    """With (11) and without (1) a last successful time; steps of 20 ms are refused."""
    outcome, recorder = fall(compiled_fmu("mass", fmi_version), trouble=trouble)
    assert outcome.statistics.rejected["discard"] > 0
    assert np.diff(recorder.time) == pytest.approx(size, abs=1e-12)
    assert recorder["mass.x"][-1] == pytest.approx(exact_x, abs=1e-13)


@both
def test_a_discard_says_how_far_it_went(compiled_fmu, fmi_version):
    mass = FmuParticipant(compiled_fmu("mass", fmi_version), start_values={"trouble": 11})
    started(mass)
    try:
        status = mass.step(0.0, 0.1)
        assert status.kind is StatusKind.DISCARD
        assert status.message == f"the step ended with fmi{fmi_version}Discard"
        assert status.last_successful_time == 0.01
        assert mass.messages == ("[discard] not that far",)
    finally:
        mass.free()


@both
def test_one_error_is_forgiven_and_more_are_not(compiled_fmu, fmi_version):
    path = compiled_fmu("mass", fmi_version)
    outcome, recorder = fall(path, trouble=12)
    assert outcome.statistics.rejected["invalid"] == 1
    assert recorder["mass.x"][-1] == pytest.approx(exact_x, abs=1e-13)
    with pytest.raises(
        ParticipantError, match=rf"^mass: the step ended with fmi{fmi_version}Error at .*lost bolt"
    ):
        fall(path, trouble=13)


ends = {
    2: "the step ended with fmi{0}Fatal at t = 0.52 s .*; it logged: .fatal. broken axle",
    3: "fmi{0}ExitInitializationMode ended with fmi{0}Error; it logged: .* 100 % sure",
    4: "claims to restore saved states but does not: [xv] after a step of",
    9: "its value of x is not finite at t = 0.52 s",
    15: "the step asked for the end of the simulation at 0.5 s at t = 0.48 s",
}


@both
@pytest.mark.parametrize("trouble", ends)
def test_what_cannot_go_on_ends_in_one_sentence(compiled_fmu, fmi_version, trouble):
    pattern = ends[trouble].format(fmi_version)
    kinds = (ParticipantError, RollbackError, StepTooSmallError)
    with pytest.raises(kinds, match=pattern) as caught:
        fall(compiled_fmu("mass", fmi_version), trouble=trouble, fixed_step=0.04, min_step=0.01)
    assert "mass" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_crash_of_an_fmi3_fmu_is_survived_when_isolated(compiled_fmu):
    with pytest.raises(
        ParticipantError, match=r"^mass: its process .* in the step, and .* t = 0\."
    ):
        fall(compiled_fmu("mass", 3), kind=IsolatedParticipant, trouble=6)


# early return


@pytest.mark.parametrize("kind", [FmuParticipant, IsolatedParticipant])
def test_an_early_return_is_landed_on_exactly(compiled_fmu, kind):
    """It returns at multiples of 0.25 s, which steps of 20 ms would miss at 0.25 and 0.75 s."""
    outcome, recorder = fall(compiled_fmu("mass", 3), kind=kind, trouble=14)
    assert {0.25, 0.5, 0.75} <= set(recorder.time.tolist())
    assert outcome.statistics.rejected == {
        "error": 0, "event": 0, "convergence": 0, "discard": 2, "invalid": 0,
    }  # fmt: skip
    # 50 steps, two of which are cut in two
    assert outcome.statistics.accepted == 52
    assert recorder["mass.x"][-1] == pytest.approx(exact_x, abs=1e-13)


def test_an_early_return_is_landed_on_under_error_control(compiled_fmu):
    settings = {"tolerance": 1e-3, "fixed_step": None, "min_step": None, "max_step": 0.06}
    outcome, recorder = fall(compiled_fmu("mass", 3), trouble=14, **settings)
    assert {0.25, 0.5, 0.75} <= set(recorder.time.tolist())
    assert outcome.statistics.rejected["discard"] == 3
    assert recorder["mass.x"][-1] == pytest.approx(exact_x, abs=1e-13)


def test_who_may_not_divide_a_step_does_not_land(compiled_fmu):
    with pytest.raises(RuntimeError, match=r"mass: the step ended early, at 0\.25 s"):
        fall(compiled_fmu("mass", 3), trouble=14, min_step=None)


def test_an_fmu_that_cannot_go_back_may_not_return_early(tmp_path):
    path = build(tmp_path, "Stubborn", fmi_version=3, canGetAndSetFMUstate=False,
                 canSerializeFMUstate=False)  # fmt: skip
    outcome, recorder = fall(path, trouble=14, min_step=None, algorithm="jacobi")
    assert outcome.statistics.accepted == 50
    assert recorder["mass.x"][-1] == pytest.approx(exact_x, abs=1e-13)


def test_early_returns_without_end_end_the_run(compiled_fmu, monkeypatch):
    plain = Fmi3Instance.step

    def impatient(self, time, step_size):
        if time < 0.5 or step_size < 1e-9:
            return plain(self, time, step_size)
        return Status(StatusKind.EARLY, "the step ended early", time + 5e-10)

    monkeypatch.setattr(Fmi3Instance, "step", impatient)
    with pytest.raises(ZenoError, match=r"^Steps ended early 51 times within 1e-06 s up to t = 0"):
        fall(compiled_fmu("mass", 3))


# check


def test_an_fmi3_fmu_holds_all_it_claims_but_what_it_was_told_not_to(compiled_fmu):
    verdicts = check_fmu(compiled_fmu("mass", 3), step_size=0.01, start_values={"trouble": 10})
    assert len(verdicts) == 6
    assert {item.claim for item in verdicts if item.holds is not True} == {"saved states are freed"}


# coupled


def test_a_spring_of_python_pulls_a_mass_of_c(compiled_fmu):
    mass = FmuParticipant(compiled_fmu("mass", 3), name="mass")
    spring = Spring("spring", lambda x: -100.0 * x, details={"force": {"nominal": 100.0}})
    wires = [
        Connection(source="mass.x", target="spring.displacement"),
        Connection(source="spring.force", target="mass.force"),
    ]
    recorder = Recorder()
    settings = MasterSettings(tolerance=None, fixed_step=1e-3)
    Master(System([mass, spring], wires), settings, observers=[recorder]).run(0.0, 1.0)
    assert recorder["mass.x"][-1] == pytest.approx(np.cos(10.0), abs=1e-4)
