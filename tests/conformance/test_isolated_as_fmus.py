"""`railcosim cosim --isolate`: crashes and hangs in any call end in time and in one sentence."""

import json
import re
import time
from pathlib import Path

import numpy as np
import pytest

from tests.conformance.faulty_fmu import faults
from tests.conformance.systems import decay, swinging

patience = 3.0
"""Time-out [s]: a process takes 0.3 s to start where nothing else runs."""

time_limit = 60.0
"""Seconds; beside the time-out, starting up to three processes on a busy machine."""


@pytest.fixture
def isolated(call):
    """Call `railcosim cosim --isolate` and see that it ends in time and leaves no process."""

    def isolated(text, *arguments):
        began, before = time.perf_counter(), children()
        answer = call(
            text, "--isolate", "--timeout", patience, "--step", 0.01, "--json", *arguments
        )
        assert time.perf_counter() - began < time_limit
        assert children() <= before
        return answer

    return isolated


def children():
    tasks = Path("/proc/self/task").iterdir()
    return {
        number
        for task in tasks
        for number in (task / "children").read_text(encoding="ascii").split()
    }


def sentence(answer):
    assert (answer.exit_code, answer.stdout) == (1, "")
    (line,) = answer.stderr.splitlines()
    assert line.startswith("railcosim: body: ")
    return line


ends = {
    "crash": r"its process was ended by SIGABRT in ",
    "hang": rf"its process gave no answer within {patience:g} s and was ended in ",
}
after_crash = {
    "crash": r", and was ended by SIGABRT when that was repeated in a new one",
    "hang": "",
}


@pytest.mark.parametrize("fault", ends)
def test_a_fault_in_a_step_is_named_with_time_and_inputs(isolated, fault):
    line = sentence(isolated(decay(fault=faults[fault], start=0.5)))
    assert re.fullmatch(
        rf"railcosim: body: {ends[fault]}the step{after_crash[fault]} at t = 0\.5 s over a step of "
        r"0\.01 s with u = -0\.60\d+\.",
        line,
    )


def test_after_one_crash_the_answer_is_the_same(isolated, call, tmp_path):
    plain = call(swinging(), "--step", 0.01, "--json")
    survived = isolated(swinging(trouble=5, label=str(tmp_path / "fuse")))
    assert survived.exit_code == 0
    (line,) = survived.stderr.splitlines()
    assert line.startswith(
        "railcosim: body: its process was ended by SIGABRT in the step at t = 0."
    )
    assert json.loads(survived.stdout)["final"] == json.loads(plain.stdout)["final"]


# Calls without an answer of their own travel with the next one that has one.
seen_in = {
    "setupExperiment": "the initialisation",
    "enterInitializationMode": "the initialisation",
    "exitInitializationMode": "the initialisation",
    "setReal": "reading its outputs",
    "getReal": "reading its outputs",
    "getFMUstate": "serialising a state",
    "setFMUstate": "the step",
    "freeFMUstate": "reading its outputs",
    "serialize": "serialising a state",
    "terminate": "terminating",
}


@pytest.mark.slow
@pytest.mark.parametrize("function", seen_in)
@pytest.mark.parametrize("fault", ends)
def test_no_call_can_take_the_run_with_it(isolated, fault, function):
    line = sentence(isolated(decay(fault=faults[fault], call=function)))
    assert re.match(rf"railcosim: body: {ends[fault]}{seen_in[function]}\b", line)


@pytest.mark.slow
@pytest.mark.parametrize("fault", ends)
def test_what_happens_after_the_end_harms_nothing(isolated, fault):
    answer = isolated(decay(fault=faults[fault], call="freeInstance"))
    assert (answer.exit_code, answer.stderr) == (0, "")
    assert json.loads(answer.stdout)["final"]["body.y"] == pytest.approx(np.exp(-1.0), abs=1e-4)
