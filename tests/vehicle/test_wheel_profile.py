import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from vehicle_fmu.parameters import FlatParameters
from vehicle_fmu.wheel_profile import WheelProfileTable, flat_along_rail, flat_profile

R, L, D = 0.45, 0.1, 0.9e-3
A = L / 2.0
SHAPES = ["haversine", "parabola", "cusp", "chord"]
# A rolled path is straight lines between points, off by h^2 / (8 R) with h = L / 2000.
ROLLED_TOLERANCE = (L / 2000.0) ** 2 / (8.0 * R)


def profile(table=None, **flat):
    return flat_profile(FlatParameters(**flat), table, radius=R)


@pytest.mark.parametrize(
    ("shape", "centre", "quarter"),
    [
        ("haversine", D, D / 2.0),
        ("parabola", D, 0.75 * D),
        ("cusp", D, D / 4.0),
        ("chord", L * L / (8.0 * R), 0.75 * L * L / (8.0 * R)),
    ],
)
def test_drop_at_centre_quarter_edge_and_outside(shape, centre, quarter):
    drop = profile(shape=shape)
    assert drop(0.0) == pytest.approx(centre, rel=1e-15)
    assert [drop(s) for s in (-A / 2.0, A / 2.0)] == pytest.approx([quarter] * 2, rel=1e-14)
    assert [drop(s) for s in (-1.0, -A, A, 1.0)] == [0.0] * 4


@pytest.mark.parametrize("rolled", [False, True])
@pytest.mark.parametrize("shape", SHAPES)
def test_drop_is_continuous_symmetric_and_falls_from_the_centre(shape, rolled):
    drop = profile(shape=shape, rolled=rolled)
    points = np.linspace(0.0, 1.1 * A, 4001)
    values = np.array([drop(s) for s in points.tolist()])
    mirrored = np.array([drop(-s) for s in points.tolist()])
    np.testing.assert_allclose(values, mirrored, rtol=0.0, atol=1e-15)
    steps = -np.diff(values)
    assert (steps >= -1e-15).all()
    # No shape is steeper than the chord at its edge, L / (2 R), here with a margin.
    assert steps.max() <= 1.1 * A / R * (points[1] - points[0])


def test_chord_has_the_depth_of_its_length_whatever_depth_is_given():
    shallow, deep = profile(shape="chord", depth=1e-6), profile(shape="chord", depth=5e-3)
    assert shallow(0.01) == deep(0.01) == pytest.approx((A * A - 1e-4) / (2.0 * R), rel=1e-14)


def test_fresh_chord_rolls_like_a_cusp_of_its_depth():
    rolled = profile(shape="chord", rolled=True)
    cusp = profile(shape="cusp", depth=L * L / (8.0 * R))
    for x in np.linspace(-1.2 * A, 1.2 * A, 777).tolist():
        assert rolled(x) == pytest.approx(cusp(x), rel=0.0, abs=1.01 * ROLLED_TOLERANCE)


def test_rolled_parabola_follows_its_closed_form():
    # min over s of d (1 - s^2/a^2) + (s - x)^2 / 2R: inside at s = x / (1 - c), else at the edge.
    rolled = profile(shape="parabola", rolled=True)
    c = 2.0 * D * R / A**2
    for x in np.linspace(0.0, A, 501).tolist():
        inside = D - c * x * x / ((1.0 - c) * 2.0 * R)
        expected = inside if x <= A * (1.0 - c) else (A - x) ** 2 / (2.0 * R)
        assert rolled(x) == pytest.approx(expected, rel=0.0, abs=1.5 * ROLLED_TOLERANCE)


@pytest.mark.parametrize("shape", SHAPES)
def test_rolled_drop_is_never_deeper_nor_sharper_than_the_wheel(shape):
    as_it_is, rolled = profile(shape=shape), profile(shape=shape, rolled=True)
    points = np.linspace(-A, A, 2001)
    e = np.array([rolled(x) for x in points.tolist()])
    r = np.array([as_it_is(x) for x in points.tolist()])
    assert (e <= r).all()
    assert (e >= 0.0).all()
    # e(x) - x^2 / 2R is a least value of straight lines, hence concave: e'' <= 1 / R. A second
    # difference carries twice the error of the sampled minimum.
    assert np.diff(e, 2).max() <= (points[1] - points[0]) ** 2 / R + 2.0 * ROLLED_TOLERANCE


knots = st.lists(st.floats(-2e-4, 1e-3), min_size=3, max_size=8).filter(lambda y: max(y) > 1e-6)


@given(knots)
@settings(deadline=None, max_examples=15)
def test_rolled_measured_profile_lies_below_the_tread_and_ends_at_zero(inner):
    distance = np.linspace(-A, A, len(inner) + 2)
    table = WheelProfileTable(distance=distance, drop=np.array([0.0, *inner, 0.0]))
    as_it_is = profile(shape="table", table=table)
    rolled = profile(shape="table", table=table, rolled=True)
    # The lowest of points h = 50 um apart is off by h^2 (r'' + 1 / R) / 8, where steps of 1.2 mm
    # over at least L / 9 have r'' up to 6 * 1.2 mm / (L / 9)^2 = 58 /m: 19 nm. Lines add 1 nm.
    tolerance = 2.0e-8
    for x in np.linspace(-2.0 * A, 2.0 * A, 301).tolist():
        assert rolled(x) <= as_it_is(x) + tolerance
    # Raised metal of 0.2 mm touches 13.4 mm early, not more.
    assert [rolled(x) for x in (-A - 0.014, A + 0.014)] == [0.0, 0.0]
    lowest = min(rolled(x) for x in np.linspace(-A, A, 2001).tolist())
    assert lowest == pytest.approx(min(0.0, *inner), abs=tolerance)


def test_measured_profile_passes_through_its_points():
    distance = np.array([-0.04, -0.01, 0.0, 0.02, 0.05])
    drop = np.array([0.0, 4e-4, 9e-4, 3e-4, 0.0])
    measured = profile(shape="table", table=WheelProfileTable(distance=distance, drop=drop))
    assert [measured(s) for s in distance.tolist()] == drop.tolist()
    assert (measured(-0.041), measured(0.051)) == (0.0, 0.0)


def test_sampled_haversine_as_a_table_is_the_haversine():
    distance = np.linspace(-A, A, 401)
    haversine = profile(shape="haversine")
    drop = np.array([haversine(s) for s in distance.tolist()])
    drop[[0, -1]] = 0.0
    measured = profile(shape="table", table=WheelProfileTable(distance=distance, drop=drop))
    for s in np.linspace(-A, A, 1234).tolist():
        # PCHIP is of second order at worst: curvature 1.8 /m times (0.25 mm)^2 / 8 is 1.4e-8.
        assert measured(s) == pytest.approx(haversine(s), rel=0.0, abs=1.4e-8)


@given(st.floats(-A, A), st.integers(-20, 20), st.sampled_from(SHAPES), st.booleans())
@settings(deadline=None, max_examples=30)
def test_periodic_flat_is_the_single_one_shifted_by_whole_turns(s, turns, shape, rolled):
    flat = {"shape": shape, "rolled": rolled, "position": 3.0}
    single = flat_along_rail(FlatParameters(**flat), None, radius=R)
    periodic = flat_along_rail(FlatParameters(**flat, periodic=True), None, radius=R)
    shifted = periodic(3.0 + s + turns * 2.0 * math.pi * R)
    # Shifting by 60 m costs 1e-14 m of position, times the largest slope of 0.11.
    assert shifted == pytest.approx(single(3.0 + s), rel=0.0, abs=5e-15)


@given(st.floats(1.01 * A, math.pi * R))
def test_periodic_wheel_is_round_between_strikes(s):
    periodic = flat_along_rail(FlatParameters(position=3.0, periodic=True), None, radius=R)
    assert periodic(3.0 + s) == periodic(3.0 - s) == 0.0
