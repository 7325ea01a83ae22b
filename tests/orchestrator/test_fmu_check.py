"""Verdicts on FMUs that keep their promises and on those that do not."""

import pytest
from mass_fmu import build

from orchestrator import FmuError, SettingsError, check_fmu

others = {
    "repeat": "two instances give the same results",
    "vary": "steps may differ in size",
    "roll back": "a saved state is restored completely",
    "leak": "saved states are freed",
    "serialise": "a state goes over into a fresh process",
}


def verdicts(path, **options):
    found = {item.claim: item for item in check_fmu(path, **options)}
    return {short: found[claim] for short, claim in others.items()}, found


def test_an_honest_fmu_passes_everything_that_is_tried(fmu):
    tried, found = verdicts(fmu, step_size=0.01)
    assert {short: item.holds for short, item in tried.items()} == dict.fromkeys(others, True)
    # The exporter leaves the list of initial unknowns empty, which the standard does not allow.
    validity = found["the file keeps to the standard"]
    assert not validity.holds
    assert "InitialUnknowns" in validity.detail


def test_an_incomplete_state_is_found(fmu):
    tried, _ = verdicts(fmu, step_size=0.01, start_values={"trouble": 4})
    failing = {short for short, item in tried.items() if not item.holds}
    assert failing == {"roll back", "serialise"}
    assert tried["roll back"].detail.startswith("x is ")


def test_inputs_vary_about_their_start_values(fmu):
    """An FMU that works near them only is a healthy one."""
    near, _ = verdicts(fmu, step_size=0.01, start_values={"force": 5.0, "trouble": 11})
    assert {short: item.holds for short, item in near.items()} == dict.fromkeys(others, True)
    far, _ = verdicts(fmu, step_size=0.01, start_values={"force": 0.0, "trouble": 11})
    assert "is far from 5 N" in far["vary"].detail


@pytest.mark.parametrize(
    ("trouble", "word"),
    [(6, "SIGSEGV"), (9, "x is not finite")],
)
def test_a_crash_is_a_verdict(fmu, trouble, word):
    tried, _ = verdicts(fmu, step_size=0.1, start_values={"trouble": trouble})
    assert tried["repeat"].holds is False
    assert word in tried["repeat"].detail
    assert "at t = 0.6 s" in tried["repeat"].detail


def test_a_crash_that_happens_once_is_one_too(fmu, tmp_path):
    values = {"trouble": 6, "label": str(tmp_path / "fuse")}
    tried, _ = verdicts(fmu, step_size=0.1, start_values=values)
    assert "SIGSEGV" in tried["repeat"].detail
    assert tried["vary"].holds


def test_a_hang_is_a_verdict_within_the_time_out(fmu):
    tried, _ = verdicts(fmu, step_size=0.1, start_values={"trouble": 8}, timeout=1.0)
    assert "no answer within 1 s" in tried["repeat"].detail


def test_a_leak_is_found(fmu):
    tried, _ = verdicts(fmu, step_size=0.01, start_values={"trouble": 10})
    failing = {short for short, item in tried.items() if not item.holds}
    assert failing == {"leak"}
    assert int(tried["leak"].detail.split()[0]) == pytest.approx(10_000, rel=0.5)


def test_what_is_not_claimed_is_not_tried(tmp_path):
    path = build(tmp_path, "OrchestratorTestModest", canGetAndSetFMUstate=False)
    tried, _ = verdicts(path)
    assert {short for short, item in tried.items() if item.holds is None} == {
        "roll back",
        "leak",
        "serialise",
    }


def test_wrong_input_is_refused(fmu, tmp_path):
    with pytest.raises(FmuError, match="no such FMU file"):
        check_fmu(tmp_path / "nothing.fmu")
    with pytest.raises(SettingsError, match="step_size = 0"):
        check_fmu(fmu, step_size=0.0)
