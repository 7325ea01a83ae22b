"""Every fault of an FMU, from the command line: the right answer, or one sentence and code 1."""

import json
import re
import time

import numpy as np
import pytest

from tests.conformance.faulty_fmu import faults
from tests.conformance.systems import decay, swinging

time_limit = 10.0
"""Seconds; a run takes a few tenths of one."""


def decayed(steps):
    """y(1) of y' = -y by the trapezoidal rule, which is what straight lines make of it."""
    half = 0.5 / steps
    return ((1.0 - half) / (1.0 + half)) ** steps


def numbers(answer):
    """Give the numbers of a run that came to its end without a word."""
    assert (answer.exit_code, answer.stderr) == (0, "")
    found = json.loads(answer.stdout)
    assert found["end_time"] == 1.0
    return found


def sentence(answer):
    """Give the one line that a failed run ends with."""
    assert (answer.exit_code, answer.stdout) == (1, "")
    (line,) = answer.stderr.splitlines()
    assert line.startswith("railcosim: ")
    assert line.endswith(".")
    return line


@pytest.fixture
def json_of(call):
    """Call `railcosim cosim --json` and hold it to the time limit."""

    def json_of(text, *arguments):
        began = time.perf_counter()
        answer = call(text, "--json", *arguments)
        assert time.perf_counter() - began < time_limit
        return answer

    return json_of


fixed = ("--step", 0.01)
divided = ("--step", 0.01, "--min-step", 1e-4)
controlled = ("--tolerance", 1e-3, "--max-step", 0.05)
explicit = ("--step", 0.01, "--algorithm", "gauss_seidel")
ways = pytest.mark.parametrize(
    "options", [fixed, divided, controlled], ids=["fixed", "divided", "controlled"]
)
halving = {"step": 0.01, "min_step": 1e-5}
# The coupling tolerance of each of 100 steps is 1e-7.
exact_in_steps = {"rel": 0.0, "abs": 1e-6}


def test_without_faults_the_answer_is_right(json_of):
    found = numbers(json_of(decay(), *fixed))
    assert found["final"]["body.y"] == pytest.approx(decayed(100), **exact_in_steps)


# fmi2Discard


def test_a_last_successful_time_is_landed_on(run):
    result = run(decay(fault=faults["discard"], start=0.5063, reported=0.5063), **halving)
    assert result.attrs["steps_rejected_discard"] == 1
    times = result["time"].to_numpy()
    assert times[51] == pytest.approx(0.5063, abs=1e-15)
    # Second order: h^2 / 12 of what decays.
    assert result["body.y"].to_numpy() == pytest.approx(np.exp(-times), abs=1e-5)


@pytest.mark.parametrize("reported", [0.2, 0.7, -1.0], ids=["past", "future", "NaN"])
def test_what_cannot_be_a_last_successful_time_is_not_believed(run, reported):
    """The step onto 0.505078125 is the only way: 65/128 of a step, which halving finds."""
    result = run(decay(fault=faults["discard"], start=0.505078125, reported=reported), **halving)
    assert result.attrs["steps_rejected_discard"] > 1
    times = result["time"].to_numpy()
    assert times[-1] == 1.0
    assert result["body.y"].to_numpy() == pytest.approx(np.exp(-times), abs=1e-5)


def test_a_discard_that_cannot_be_got_around_is_named(json_of):
    text = decay(fault=faults["discard"], start=0.5 + 1e-7, reported=0.0)
    for options in (fixed, divided, controlled):
        line = sentence(json_of(text, *options))
        assert re.search(
            r"body: the step ended with fmi2Discard at t = 0\.\d+ s .* u = -0\.6", line
        )
    line = sentence(json_of(text, *explicit))
    assert "body: the step ended with fmi2Discard at t = 0.5 s" in line
    assert "unless min_step is given" in line


def test_an_fmu_that_takes_short_steps_only_gets_them(json_of):
    """It refuses steps beyond 15 ms without a last successful time."""
    found = numbers(json_of(swinging(trouble=1), "--step", 0.02, "--min-step", 1e-3))
    assert found["steps"]["rejected"]["discard"] == 50
    assert found["steps"]["accepted"] == 100
    # x = cos(10 t); straight lines of 0.01 s change the frequency by (10 h)^2 / 24 or so.
    assert found["final"]["body.x"] == pytest.approx(np.cos(10.0), abs=5e-3)
    soft = swinging(stiffness=1.0, trouble=1)
    found = numbers(json_of(soft, "--tolerance", 1e-2, "--max-step", 0.1))
    assert found["steps"]["rejected"]["discard"] > 0
    assert found["final"]["body.x"] == pytest.approx(np.cos(1.0), abs=1e-4)


# fmi2Error and fmi2Fatal


@ways
def test_one_error_leaves_no_trace(json_of, options):
    found = numbers(json_of(decay(fault=faults["error"], start=0.5, times=1), *options))
    assert found["steps"]["rejected"]["invalid"] == 1
    # Second order in the step, of 0.05 s at most.
    assert found["final"]["body.y"] == pytest.approx(np.exp(-1.0), abs=1e-4)
    if options == fixed:
        assert found["final"] == numbers(json_of(decay(), *options))["final"]


@ways
def test_errors_that_do_not_end_are_named(json_of, options):
    line = sentence(json_of(decay(fault=faults["error"], start=0.5), *options))
    assert re.match(
        r"railcosim: body: the step ended with fmi2Error at t = 0\.5\d* s over a step of \S+ s "
        r"with u = -0\.[56]\d+\.$",
        line,
    )


def test_an_error_is_the_end_where_no_states_are_saved(json_of):
    line = sentence(json_of(decay(fault=faults["error"], start=0.5, times=1), *explicit))
    assert "body: the step ended with fmi2Error at t = 0.5 s" in line
    assert "unless min_step is given" in line


functions = [
    "setupExperiment",
    "enterInitializationMode",
    "exitInitializationMode",
    "setReal",
    "getReal",
    "doStep",
    "getFMUstate",
    "setFMUstate",
    "freeFMUstate",
    "terminate",
]


@pytest.mark.parametrize("function", functions)
@pytest.mark.parametrize("fault", ["error", "fatal"])
def test_no_call_fails_in_silence_and_the_dead_are_left_alone(json_of, tmp_path, fault, function):
    witness = tmp_path / "witness"
    text = decay(fault=faults[fault], call=function, witness=str(witness))
    line = sentence(json_of(text, *divided))
    assert "body: " in line
    assert f"fmi2{fault.capitalize()}" in line
    assert not witness.exists()


def test_the_dead_are_left_alone_in_the_middle_of_a_run(json_of, tmp_path):
    witness = tmp_path / "witness"
    text = decay(fault=faults["fatal"], start=0.5, witness=str(witness))
    line = sentence(json_of(text, *fixed))
    assert line.startswith("railcosim: body: the step ended with fmi2Fatal at t = 0.5 s over a ")
    assert not witness.exists()


def test_an_exception_in_an_fmu_is_quoted(json_of):
    line = sentence(json_of(swinging(trouble=2), *fixed))
    assert line.startswith("railcosim: body: the step ended with fmi2Fatal at t = 0.51 s")
    assert "broken axle" in line


# values that are not finite


@ways
def test_nan_is_named(json_of, options):
    line = sentence(json_of(decay(fault=faults["nan"], start=0.5), *options))
    # u is the negative of the decaying y, exp(-t), about a step beyond 0.5 s.
    assert re.search(r"body: its value of y is not finite at t = 0\.5\d* s .*u = -0\.(6|59)", line)


def test_one_nan_leaves_no_trace(json_of):
    text = decay(fault=faults["nan"], start=0.5, times=1)
    for options in (divided, controlled):
        found = numbers(json_of(text, *options))
        assert found["steps"]["rejected"]["invalid"] == 1
        assert found["final"]["body.y"] == pytest.approx(np.exp(-1.0), abs=1e-4)


# saved states


def test_a_liar_is_named_at_the_start(json_of):
    line = sentence(json_of(swinging(trouble=4), *fixed))
    assert re.match(r"railcosim: body claims to restore saved states but does not: x after", line)
    assert "from t = 0 s" in line


@pytest.mark.parametrize("options", [fixed, explicit], ids=["newton", "explicit"])
def test_a_check_that_finds_nothing_out_is_not_passed_over(json_of, options):
    """The step of the check and its halves fail, all steps after that work."""
    answer = json_of(decay(fault=faults["error"], times=6), *options)
    assert answer.exit_code == 0
    (doubt,) = answer.stderr.splitlines()
    assert doubt.startswith("railcosim: Whether body restores saved states could not be checked: ")
    assert "body: the step ended with fmi2Error at t = 0 s" in doubt
    assert json.loads(answer.stdout)["final"]["body.y"] == pytest.approx(np.exp(-1.0), abs=1e-4)


def test_one_without_saved_states_steps_last_and_once(json_of):
    """It hangs behind a swinging mass whose steps are rejected again and again."""
    text = swinging(trouble=1, behind="ConformanceOnward.fmu")
    found = numbers(json_of(text, "--step", 0.02, "--min-step", 1e-3))
    assert found["steps"]["rejected"]["discard"] == 50
    assert found["final"]["behind.steps"] == found["steps"]["accepted"] == 100
    # Its force is the displacement cos(10 t): twice integrated from x = 1 at rest.
    exact = 1.0 + (1.0 - np.cos(10.0)) / 100.0
    assert found["final"]["behind.x"] == pytest.approx(exact, abs=1e-4)


def test_one_without_saved_states_within_a_loop_is_for_explicit_algorithms(json_of):
    text = swinging(source="ConformanceOnward.fmu", stiffness=1.0)
    line = sentence(json_of(text, *fixed))
    assert "body cannot save its state" in line
    assert "body.x drives law.u" in line
    answer = json_of(text, *explicit)
    assert answer.exit_code == 0
    (doubt,) = answer.stderr.splitlines()
    assert "body cannot save the state it starts from" in doubt
    # x = cos(t), and forces extrapolated over 0.01 s.
    assert json.loads(answer.stdout)["final"]["body.x"] == pytest.approx(np.cos(1.0), abs=1e-4)


def test_two_without_saved_states_are_refused(json_of):
    text = swinging(source="ConformanceOnward.fmu", behind="ConformanceOnward.fmu")
    line = sentence(json_of(text, *fixed))
    assert "body and behind cannot save their states" in line
