"""The master's own time per step, by the benchmark, next to bare calls of the same FMUs."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.xdist_group("benchmark")  # they share one run

root = Path(__file__).resolve().parents[2]

limits = {
    "jacobi": 5.5,
    "gauss_seidel": 5.5,
    "gauss_seidel, extrapolated": 7.0,
    "jacobi, recorded": 9.0,
    "newton": 15.0,
    "newton, recorded": 18.0,
    "newton, error control": 17.0,
}
"""Over the raw calls in the same process: less than twice what a quiet machine measures."""


@pytest.fixture(scope="module")
def rows():
    done = subprocess.run(
        [
            sys.executable,
            str(root / "benchmarks" / "master.py"),
            *("--short", "--json", "--steps", "1000", "--repetitions", "15"),
        ],
        env={**os.environ, "PYTHONPATH": str(root)},
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
    )
    assert done.returncode == 0, done.stderr
    return {row["name"]: row for row in json.loads(done.stdout)["compiled"]}


@pytest.mark.parametrize("name", limits)
def test_a_step_costs_a_few_times_the_bare_calls(rows, name):
    assert rows[name]["ratio"] < limits[name]


def test_what_is_timed_gives_the_right_numbers(rows):
    checked = [row for row in rows.values() if row["error"] is not None]
    assert len(checked) == 7
    # Explicit rows differ by rounding, implicit ones by the tolerance of the iteration.
    assert max(row["error"] for row in checked) < 1e-8


def test_an_implicit_step_takes_two_iterations(rows):
    assert rows["newton"]["iterations"] == pytest.approx(2.0, abs=0.01)
