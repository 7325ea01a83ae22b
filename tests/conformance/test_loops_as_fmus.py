"""A spring that is pushed and a compliance in series close an algebraic loop of gain k D."""

import json
import subprocess
import sys

import numpy as np
import pytest

from tests.conformance.systems import loop

ladder = [0.3, 0.9, 1.05, 1.5, 4.5]
held = {"algorithm": "gauss_seidel", "extrapolate": False}


def misses(result, gain):
    """How far the support is from g / (1 + g) sin(t)."""
    exact = gain / (1.0 + gain) * np.sin(result["time"].to_numpy())
    return np.abs(result["support.y"].to_numpy() - exact)


@pytest.mark.parametrize("gain", ladder)
def test_newton_is_right_whatever_the_gain(run, gain):
    result = run(loop(gain, coupling_tolerance=1e-10), step=0.01)
    # The residual, 1e-10 of a nominal value of 1, over 1 + g.
    assert misses(result, gain).max() < 1e-10
    assert result.attrs["iterations"] <= 2 * result.attrs["steps_accepted"] + 1


@pytest.mark.parametrize("gain", ladder)
def test_newton_is_right_under_error_control(run, gain):
    result = run(loop(gain, coupling_tolerance=1e-10), tolerance=1e-4)
    assert result.attrs["simulated_time"] == 1.0
    assert misses(result, gain).max() < 1e-10


@pytest.mark.parametrize("gain", ladder)
@pytest.mark.parametrize("algorithm", ["gauss_seidel", "jacobi"])
def test_an_explicit_algorithm_is_right_in_doubt_or_refused(call, algorithm, gain):
    # Jacobi takes two steps for one way through the loop.
    strength = gain if algorithm == "gauss_seidel" else np.sqrt(gain)
    text = loop(gain, algorithm=algorithm, extrapolate=False)
    answer = call(text, "--step", 0.001, "--json")
    if strength >= 1.0:
        assert (answer.exit_code, answer.stdout) == (1, "")
        (line,) = answer.stderr.splitlines()
        assert f"has a gain of {strength:.3g} over a step of 0.001 s" in line
        assert "use the algorithm newton" in line
        return
    assert answer.exit_code == 0
    exact = gain / (1.0 + gain) * np.sin(1.0)
    # Each way through the loop brings the change of a step once more, damped by the gain.
    ways = 1 if algorithm == "gauss_seidel" else 2
    allowed = ways * 0.001 * gain / (1.0 - gain)
    assert json.loads(answer.stdout)["final"]["support.y"] == pytest.approx(exact, abs=allowed)
    lines = answer.stderr.splitlines()
    assert len(lines) == (strength > 0.5)
    for line in lines:
        assert f"has a gain of {strength:.3g}" in line


@pytest.mark.parametrize("gain", ladder)
def test_extrapolation_is_refused_from_a_third_on(call, gain):
    """z <- -g (2 z - z_before) grows by g + sqrt(g^2 + g) a step: by 1 for g = 1/3."""
    answer = call(loop(gain, algorithm="gauss_seidel"), "--step", 0.001, "--json")
    if gain < 1.0 / 3.0:
        assert (answer.exit_code, answer.stderr) == (0, "")
        exact = gain / (1.0 + gain) * np.sin(1.0)
        # The extrapolation misses h^2 sin(t), the transient from the start has died out.
        assert json.loads(answer.stdout)["final"]["support.y"] == pytest.approx(exact, abs=1e-5)
    else:
        assert (answer.exit_code, answer.stdout) == (1, "")
        (line,) = answer.stderr.splitlines()
        assert "use the algorithm newton" in line


def test_a_doubt_is_said_once(put):
    """Also where nobody listens to the log: in a process of its own."""
    path = put(loop(0.9, algorithm="gauss_seidel", extrapolate=False))
    command = [sys.executable, "-m", "railcosim", "cosim", str(path), "--step", "0.01", "--json"]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60)
    (line,) = done.stderr.splitlines()
    assert line.startswith("railcosim: An explicit algorithm is in doubt, because the loop through")
    assert json.loads(done.stdout)["end_time"] == 1.0
