"""A master with a mistake in it must not pass: the tests are tested."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.conformance.mutants import mutants

root = Path(__file__).resolve().parents[2]

subset = [
    "tests/orchestrator/test_rejections.py",
    "tests/orchestrator/test_rollback.py",
    "tests/orchestrator/test_newton.py",
    "tests/orchestrator/test_quasi_newton.py",
    "tests/orchestrator/test_drop.py::test_accepted_points_lie_on_the_switches",
    "tests/orchestrator/test_drop.py::test_nothing_is_predicted_across_a_switch",
    "tests/orchestrator/test_fmu.py::test_an_fmu_oscillates_like_the_closed_form",
]
"""Fast tests that find every one of the mutants."""

all_passed, some_failed = 0, 1
"""Exit codes of pytest; others mean that it did not get so far."""


def examine(*options):
    """Run the tests in a process of its own up to the first that fails; plugins cost time."""
    command = [sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", *options]
    return subprocess.run(
        [*command, *subset],
        cwd=root,
        env={**os.environ, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", "OPENBLAS_NUM_THREADS": "1"},
        capture_output=True,
        text=True,
        check=False,
        timeout=300.0,
    )


def test_the_master_as_it_is_passes():
    done = examine("-p", "tests.conformance.mutants")
    assert done.returncode == all_passed, done.stdout


@pytest.mark.parametrize(
    "mutant",
    [
        pytest.param(name, marks=[] if name == "restores_nothing" else pytest.mark.slow)
        for name in mutants
    ],
)
def test_a_master_with_a_mistake_fails(mutant):
    done = examine("-p", "tests.conformance.mutants", "--mutant", mutant)
    assert done.returncode == some_failed, done.stdout
    assert "1 failed" in done.stdout
