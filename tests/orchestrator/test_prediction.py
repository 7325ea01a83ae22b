"""The straight line through the last accepted point and another one."""

import numpy as np
import pytest

from orchestrator.prediction import History

unbounded = np.array([-np.inf]), np.array([np.inf])


def test_a_straight_line_is_continued_whatever_the_steps():
    history = History(*unbounded)
    history.restart(np.array([1.0]))
    assert history.predict(0.5) == pytest.approx([1.0])
    assert not history.has_slope
    history.append(np.array([1.2]), 0.1)
    assert history.predict(0.5) == pytest.approx([2.2])
    history.append(np.array([1.8]), 0.3)
    assert history.predict(0.1) == pytest.approx([2.0])


def test_a_restart_forgets_the_slope():
    history = History(*unbounded)
    history.restart(np.array([1.0]))
    history.append(np.array([2.0]), 1.0)
    history.restart(np.array([5.0]))
    assert not history.has_slope
    assert history.predict(1.0) == pytest.approx([5.0])


def test_no_prediction_leaves_its_bounds():
    history = History(np.array([0.0, -np.inf]), np.array([np.inf, 3.0]))
    history.restart(np.array([2.0, 1.0]))
    history.append(np.array([1.0, 2.0]), 1.0)
    assert history.predict(5.0).tolist() == [0.0, 3.0]


def test_predictions_are_independent_of_each_other():
    history = History(*unbounded)
    history.restart(np.array([1.0]))
    first = history.predict(1.0)
    first[0] = 9.0
    assert history.last.tolist() == [1.0]
    history.append(np.array([2.0]), 1.0)
    kept = history.predict(1.0)
    history.predict(2.0)
    assert kept == pytest.approx([3.0])


@pytest.mark.parametrize("size", [0.1, 0.5, 2.0])
def test_the_miss_of_a_parabola_tells_its_curvature_whatever_the_steps(size):
    def parabola(t):
        return np.array([1.0 - 2.0 * t + 1.5 * t**2])

    history = History(*unbounded)
    history.restart(parabola(-0.25))
    history.append(parabola(0.0), 0.25)
    miss = abs(parabola(size) - history.predict(size))[0] * history.curvature_factor(size)
    assert miss == pytest.approx(3.0 * size**2, rel=1e-12)
    history.restart(parabola(0.0))
    assert not history.has_past
    history.look_ahead(parabola(3.0), 3.0)
    assert history.has_slope
    assert not history.has_past
    miss = abs(parabola(size) - history.predict(size))[0] * history.curvature_factor(size)
    assert miss == pytest.approx(3.0 * size**2, rel=1e-12)
