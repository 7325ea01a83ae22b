from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from vehicle_fmu.speed import ConstantSpeed, SpeedTable

tables = st.lists(
    st.tuples(st.floats(0.01, 2.0), st.floats(0.5, 80.0)), min_size=2, max_size=8
).map(
    lambda rows: SpeedTable(
        time=np.cumsum([w for w, _ in rows]), speed=np.array([v for _, v in rows])
    )
)
times = st.floats(-2.0, 20.0)


def exact_distance(table, start, end):
    """Integrate the held, piecewise linear speed in rational arithmetic."""
    t = [Fraction(x) for x in table.time.tolist()]
    v = [Fraction(x) for x in table.speed.tolist()]

    def speed(time):
        if time <= t[0]:
            return v[0]
        for k in range(len(t) - 1):
            if time <= t[k + 1]:
                return v[k] + (v[k + 1] - v[k]) * (time - t[k]) / (t[k + 1] - t[k])
        return v[-1]

    nodes = [start, *(x for x in t if start < x < end), end]
    return sum((b - a) * (speed(a) + speed(b)) / 2 for a, b in pairwise(nodes))


@given(tables, times, times)
@settings(deadline=None)
def test_distance_is_the_exact_integral_of_the_speed(table, one, other):
    start, end = sorted((one, other))
    expected = exact_distance(table, Fraction(start), Fraction(end))
    # Distances from the first time reach 1600 m and cancel: 1600 eps of each, and a few roundings.
    assert table.distance(start, end) == pytest.approx(float(expected), rel=1e-14, abs=4e-12)


@given(tables, times, times)
def test_way_back_is_the_negative_way(table, one, other):
    assert table.distance(one, other) == -table.distance(other, one)


def test_uniform_acceleration_closed_form():
    table = SpeedTable(time=np.array([1.0, 3.0]), speed=np.array([10.0, 14.0]))
    assert table.distance(1.0, 2.0) == 10.0 + 0.5 * 2.0
    assert table.distance(1.0, 5.0) == 24.0 + 28.0
    assert table.distance(0.0, 1.0) == 10.0


@given(st.floats(0.1, 100.0), times, times)
def test_constant_table_is_constant_speed(speed, start, time):
    table = SpeedTable(time=np.array([0.0, 1.0, 7.0]), speed=np.full(3, speed))
    # Both are products of order 1e3 m with a few roundings.
    assert table.distance(start, time) == pytest.approx(
        ConstantSpeed(speed=speed).distance(start, time), rel=1e-14, abs=2e-12
    )
