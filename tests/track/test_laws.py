"""Force laws, exponential steps, support selection: the small parts of the track."""

import numpy as np
import pytest
from scipy.integrate import quad

from track_fmu.ballast import PolynomialBallast, secant_displacement
from track_fmu.exponential_step import SERIES_LIMIT, exponential_step
from track_fmu.parameters import TrackParameters
from track_fmu.supports import nearest_supports

BALLAST = PolynomialBallast()
SUPPORTS = np.arange(5)


def test_polynomial_mimics_the_measured_secant_stiffness():
    """Eq. (27) with the linear 30 MN/m was fitted to Eq. (26) over the loads of the example."""
    force = np.linspace(5e3, 55e3, 11)
    x = secant_displacement(force)
    fitted = 30e6 * x + BALLAST.force(x, np.zeros_like(x), np.arange(len(x)))
    assert np.abs(fitted - force).max() < 2.0e3


def test_a_lifted_sleeper_has_no_increment():
    lifted = np.array([-1e-3, -1e-9, 0.0])
    assert not BALLAST.force(lifted, np.full(3, 0.1), SUPPORTS[:3]).any()
    assert not BALLAST.stiffness(lifted, 0.0 * lifted, SUPPORTS[:3]).any()


def test_damping_is_the_secant_one():
    """tau x' times Eq. (27) over x, Eq. (30), which gives a loss factor 0.39 at 60 Hz."""
    x, v = np.array([0.1e-3, 0.4e-3]), np.array([0.02, -0.05])
    elastic = BALLAST.force(x, 0.0 * v, SUPPORTS[:2])
    viscous = BALLAST.force(x, v, SUPPORTS[:2]) - elastic
    assert viscous == pytest.approx(BALLAST.tau * v * elastic / x, rel=1e-12)
    assert 2 * np.pi * 60 * BALLAST.tau == pytest.approx(0.39, abs=0.001)


def test_stiffness_is_the_derivative_of_the_force():
    x, step = np.array([0.05e-3, 0.2e-3, 0.5e-3]), 1e-9
    rest = np.zeros(3)
    ahead, behind = (BALLAST.force(x + d, rest, SUPPORTS[:3]) for d in (step, -step))
    slope = (ahead - behind) / (2 * step)
    assert BALLAST.stiffness(x, rest, SUPPORTS[:3]) == pytest.approx(slope, rel=1e-6)
    moving = BALLAST.force(x, rest + 0.1, SUPPORTS[:3]) - BALLAST.force(x, rest, SUPPORTS[:3])
    assert BALLAST.damping(x, rest, SUPPORTS[:3]) == pytest.approx(moving / 0.1, rel=1e-9)


@pytest.mark.parametrize("values", [{"alpha": float("inf")}, {"tau": -1e-3}])
def test_wrong_coefficients_are_refused(values):
    with pytest.raises(ValueError, match=next(iter(values))):
        PolynomialBallast(**values)


@pytest.mark.parametrize("z", [-1e-9, -0.1, -0.19 + 0.05j, -0.3 + 0.1j, -0.5 + 40j, -700.0])
def test_exponential_step_is_exact_under_a_linear_load(z):
    step = 1e-4
    value = np.array([z / step], dtype=complex)
    coefficients = exponential_step(value, step)

    def part(weight, attribute):
        return quad(lambda s: getattr(np.exp(z * (1 - s)) * weight(s), attribute), 0, 1, limit=500)[
            0
        ]

    for computed, weight in (
        (coefficients.start, lambda s: 1 - s),
        (coefficients.end, lambda s: s),
    ):
        expected = step * complex(part(weight, "real"), part(weight, "imag"))
        assert computed[0] == pytest.approx(expected, rel=1e-9, abs=1e-12 * step)
    assert coefficients.decay[0] == pytest.approx(np.exp(z), rel=1e-14)


def test_series_and_closed_form_meet():
    step = 1e-4
    around = np.array([-SERIES_LIMIT * (1 - 1e-12), -SERIES_LIMIT * (1 + 1e-12)], dtype=complex)
    result = exponential_step(around / step, step)
    assert result.end[0] == pytest.approx(result.end[1], rel=1e-11)
    assert result.start[0] == pytest.approx(result.start[1], rel=1e-11)


def test_nearest_supports_are_the_nearest():
    parameters = TrackParameters()
    places = 0.65 * np.arange(1, 50)
    for position in np.linspace(0.3, 32.2, 137):
        chosen = nearest_supports(parameters, np.array([position]), 6)
        assert len(chosen) == 6
        distance = np.abs(places - position)
        others = np.delete(distance, chosen)
        assert distance[list(chosen)].max() <= others.min() + 1e-9


def test_wheels_share_supports_and_a_short_track_has_no_more_than_it_has():
    parameters = TrackParameters(bays=20)
    bogie = nearest_supports(parameters, np.array([6.6, 4.8]), 6)
    assert bogie == tuple(sorted(set(bogie)))
    assert 6 < len(bogie) < 12
    assert nearest_supports(parameters, np.array([6.6]), 30) == tuple(range(19))
