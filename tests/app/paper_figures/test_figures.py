import numpy as np
import pytest
import xarray as xr

from railcosim.figures.histories import draw_histories
from railcosim.figures.speed import MARKERS, Points, draw_over_speed, fit
from railcosim.scenario import Scenario
from railcosim.track_section import Track

SPEEDS = np.arange(5.0, 101.0, 5.0)


def quintic(speed):
    x = speed / 100.0
    return 1e5 * (1.0 + x - 2.0 * x**2 + 3.0 * x**3 - 1.5 * x**5)


@pytest.fixture
def peaks():
    values = np.column_stack((quintic(SPEEDS), 0.7 * quintic(SPEEDS)))
    return xr.DataArray(
        values,
        dims=("speed_kmh", "ballast"),
        coords={"speed_kmh": SPEEDS, "ballast": ["state_dependent", "linear"]},
    )


def test_the_fit_is_the_polynomial_of_fifth_order_that_lies_below():
    between = np.linspace(5.0, 100.0, 77)
    np.testing.assert_allclose(fit(SPEEDS, quintic(SPEEDS))(between), quintic(between), rtol=1e-11)


def test_the_fit_is_one_of_least_squares():
    """What is left over is at right angles to every power up to the fifth."""
    values = quintic(SPEEDS) + 1e3 * np.random.default_rng(5).normal(size=SPEEDS.size)
    left = values - fit(SPEEDS, values)(SPEEDS)
    powers = np.vander(SPEEDS / 100.0, 6)
    assert np.abs(powers.T @ left).max() < 1e-9 * np.abs(powers.T @ values).max()


def test_six_speeds_are_too_few_for_a_fit(peaks):
    assert fit(SPEEDS[:6], quintic(SPEEDS[:6])) is None
    assert fit(np.repeat(SPEEDS[:6], 3), np.ones(18)) is None
    assert len(draw_over_speed(peaks[:6], "peak").axes[0].lines) == 2


def test_every_track_has_its_marker_and_its_fit(peaks):
    axes = draw_over_speed(peaks, "peak contact force [kN]").axes[0]
    lines = {line.get_label(): line for line in axes.lines}
    assert lines["state-dependent track"].get_marker() == "s"
    assert lines["linear track"].get_marker() == "o"
    np.testing.assert_allclose(
        lines["linear track"].get_ydata(), 0.7e-3 * quintic(SPEEDS), rtol=1e-12
    )
    assert len(axes.lines) == 4
    assert axes.get_ylabel() == "peak contact force [kN]"


def test_measured_points_are_asterisks_with_a_fit_where_there_are_enough(peaks):
    many = Points(name="measured (many)", speed=SPEEDS, value=1.1 * quintic(SPEEDS))
    few = Points(name="measured (few)", speed=SPEEDS[:2], value=np.ones(2))
    axes = draw_over_speed(peaks, "peak", [many, few]).axes[0]
    markers = {line.get_label(): line.get_marker() for line in axes.lines}
    assert markers["measured (many)"] == markers["measured (few)"] == "*"
    assert len(axes.lines) == 4 + 2 + 1
    colours = {line.get_color() for line in axes.lines if line.get_marker() == "*"}
    assert len(colours) == 2


def test_histories_count_time_from_the_strike(make_passage):
    distance = np.linspace(-3.9, 2.6, 651)
    force = np.where(np.abs(distance) < 0.05, 2e5, 1e5)
    sleeper = np.exp(-((distance - 0.3) ** 2)) * 1e-3
    series = {
        "contact_force": {1: force},
        "sleeper_displacement": {25: sleeper, 26: 2.0 * sleeper},
        "bending_moment": {1: 1e4 * sleeper},
    }
    passages = {
        ballast: make_passage(distance, Scenario(track=Track(ballast=ballast)), series=series)
        for ballast in MARKERS
    }
    panels = draw_histories(passages).axes
    speed = 40.0 / 3.6
    for axes, peak in zip(panels, (200.0, 2.0, 1e-5 * 1e3), strict=True):
        first, second = axes.lines[:2]
        assert first.get_label() == "state-dependent track"
        assert second.get_label() == "linear track"
        time = first.get_xdata()
        np.testing.assert_allclose(time[[0, -1]], [-500.0 / speed, 1000.0 / speed], atol=0.1)
        assert first.get_ydata().max() == pytest.approx(peak, rel=1e-3)
    struck = panels[0].lines[0]
    middle = struck.get_xdata()[struck.get_ydata() > 150.0].mean()
    assert middle == pytest.approx(0.0, abs=0.9)  # ms, a sample of the distance
