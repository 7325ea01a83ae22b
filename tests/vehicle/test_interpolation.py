import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import PchipInterpolator

from vehicle_fmu.interpolation import linear_curve, monotone_curve, periodic_monotone_curve

tables = st.lists(
    st.tuples(st.floats(0.1, 3.0), st.floats(-1.0, 1.0).map(lambda y: round(y, 6))),
    min_size=4,
    max_size=12,
).map(lambda rows: (np.cumsum([w for w, _ in rows]), np.array([y for _, y in rows])))


@given(tables)
@settings(deadline=None)
def test_monotone_curve_is_scipy_pchip(table):
    x, y = table
    curve, reference = monotone_curve(x, y), PchipInterpolator(x, y)
    points = np.linspace(x[0], x[-1], 101)
    # The same formulas in another order of operations, values of order 1.
    np.testing.assert_allclose([curve(p) for p in points.tolist()], reference(points), atol=1e-12)


@given(tables, st.floats(0.0, 1.0))
@settings(deadline=None)
def test_monotone_curve_stays_between_neighbours(table, fraction):
    x, y = table
    curve = monotone_curve(x, y)
    for k in range(x.size - 1):
        value = curve(float(x[k] + fraction * (x[k + 1] - x[k])))
        assert min(y[k], y[k + 1]) - 1e-14 <= value <= max(y[k], y[k + 1]) + 1e-14


@pytest.mark.parametrize("build", [linear_curve, monotone_curve])
def test_curve_meets_its_points_and_is_held_beyond_them(build):
    x, y = np.array([0.0, 1.0, 2.5, 3.0]), np.array([0.5, -1.0, 2.0, 0.25])
    curve = build(x, y)
    assert [curve(p) for p in x.tolist()] == y.tolist()
    assert (curve(-7.0), curve(9.0)) == (0.5, 0.25)


def test_linear_curve_is_linear():
    x, y = np.array([0.0, 0.5, 2.0]), np.array([1.0, 2.0, -1.0])
    points = np.linspace(-1.0, 3.0, 41)
    curve = linear_curve(x, y)
    np.testing.assert_allclose(
        [curve(p) for p in points.tolist()], np.interp(points, x, y), rtol=0.0, atol=1e-15
    )


def test_monotone_curve_converges_with_order_three_at_least():
    def error(intervals):
        x = np.linspace(0.0, 1.0, intervals + 1)
        curve = monotone_curve(x, np.exp(x))
        points = np.linspace(0.0, 1.0, 1001)
        return max(abs(curve(p) - np.exp(p)) for p in points.tolist())

    # The weighted harmonic mean is a second-order slope, so the curve is of third order.
    assert error(20) / error(40) > 0.9 * 2.0**3


@given(tables)
@settings(deadline=None)
def test_a_periodic_curve_is_the_middle_of_three_periods(table):
    x, y = table
    period = float(x[-1] - x[0]) + 0.7
    curve = periodic_monotone_curve(x, y, period)
    three = PchipInterpolator(
        np.concatenate([x - period, x, x + period]), np.concatenate([y, y, y])
    )
    points = np.linspace(x[0], x[0] + period, 101)
    # As above; ends of three periods are far from the middle one.
    np.testing.assert_allclose([curve(p) for p in points.tolist()], three(points), atol=1e-12)
