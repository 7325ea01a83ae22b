"""A run that diverges is told from one that resolves what it computes."""

import numpy as np
import pytest
from fake_participants import drop, oscillators

from orchestrator import DivergenceError, Master, MasterSettings
from orchestrator.divergence import DivergenceMonitor, fewest_windows, window


def follow(series, *, extrapolate=True, nominal=1.0):
    """Show a monitor the series and its straight-line extrapolation."""
    monitor = DivergenceMonitor(["loop.value"], np.array([nominal]))
    series = np.asarray(series, dtype=float)
    for n in range(2, series.size):
        expected = 2.0 * series[n - 1] - series[n - 2] if extrapolate else series[n - 1]
        monitor.accept(np.array([expected]), series[n : n + 1], 0.01 * n)
    return monitor


def late(steps=400):
    return np.arange(steps, dtype=float)


@pytest.mark.parametrize("extrapolate", [True, False])
@pytest.mark.parametrize("root", [-1.05, -1.5, -3.0, 1.05j, 1.5j])
def test_growing_jumps_are_found(root, extrapolate):
    with pytest.raises(DivergenceError, match=r"loop\.value missed .* use the algorithm newton"):
        follow(1e-3 * np.real((root + 0j) ** late()), extrapolate=extrapolate)


@pytest.mark.parametrize("extrapolate", [True, False])
@pytest.mark.parametrize(
    "series",
    [
        np.exp(0.2 * late(1000)),
        np.exp(0.02 * late()) * np.cos(0.4 * late()),
        1e5 + np.sin(0.3 * late()),
        np.where(late() < 200, 0.0, 1e6),
        np.where(late() < 200, 0.0, 1e6 * np.exp(-0.3 * (late() - 200)) * np.cos(late())),
        np.maximum(np.sin(0.05 * late()), 0.0) ** 1.5,
        1e-14 * np.random.default_rng(1).standard_normal(400),
        np.abs(late(1000) % 14 - 7.0),
    ],
    ids=["growth", "wave", "offset", "jump", "impact", "contact", "rounding", "kinks"],
)
def test_what_is_resolved_or_jumps_once_is_left_alone(series, extrapolate):
    assert follow(series, extrapolate=extrapolate).warning == ""


def test_lasting_jumps_without_growth_are_warned_of():
    monitor = follow(np.random.default_rng(1).standard_normal(1000))
    assert "too large for loop.value, which jumps about" in monitor.warning


def test_divergence_is_found_soon_after_it_shows():
    found = []
    series = 1e-2 * (-1.3) ** late()
    try:
        follow(series)
    except DivergenceError as error:
        found.append(str(error))
    assert found
    # Growth by 100 takes 18 steps, which is less than the windows that are asked for.
    time = float(found[0].partition("before t = ")[2].partition(" s")[0])
    assert time <= 0.01 * (fewest_windows + 1) * window


def test_the_next_step_after_a_restart_is_passed_over():
    monitor = DivergenceMonitor(["loop.value"], np.array([1.0]))
    for n in range(1000):
        monitor.restart()
        monitor.accept(np.array([0.0]), np.array([(-2.0) ** (n % 50)]), 0.01 * n)
    assert monitor.warning == ""


@pytest.mark.parametrize("algorithm", ["jacobi", "gauss_seidel"])
def test_explicit_runs_that_follow_are_left_alone(algorithm):
    settings = MasterSettings(tolerance=None, fixed_step=1e-3, algorithm=algorithm)
    outcome = Master(oscillators(), settings).run(0.0, 2.0)
    assert (outcome.warnings, outcome.unreliable) == ((), ())
    falling = Master(drop(), settings, events=["ball.gap"]).run(0.0, 1.0)
    assert falling.finished
