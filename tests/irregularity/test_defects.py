"""Shapes of defects and of the windows that let irregularities set in."""

import math

import numpy as np
import pytest

from railcosim.irregularity.rail_defects import corrugation, dip, joint_depth
from railcosim.irregularity.wheel_defects import amplitude_of, dent, polygon
from railcosim.irregularity.windows import onset, stretch

RADIUS = 0.45


def test_a_dipped_joint_has_the_angle_that_its_depth_was_worked_out_from():
    depth = joint_depth(0.012, 0.8)
    h = 1e-7
    x = 5.0 + np.array([-h, 0.0, h])
    before, at, after = dip(x, centre=5.0, length=0.8, depth=depth, shape="cusp")
    # one-sided differences of a parabola are off by h over the half length
    assert (at - before) / h + (at - after) / h == pytest.approx(0.012, rel=1e-6)


@pytest.mark.parametrize("shape", ["cusp", "haversine"])
def test_a_dip_ends_smoothly_where_it_should(shape):
    x = 5.0 + np.array([-0.5, -0.4, -0.4 + 1e-6, 0.0, 0.4, 0.5])
    drop = dip(x, centre=5.0, length=0.8, depth=2e-3, shape=shape)
    assert drop[[0, 1, 4, 5]] == pytest.approx(np.zeros(4), abs=1e-17)
    assert drop[2] < 1e-13  # of second order
    assert drop[3] == 2e-3


def test_corrugation_goes_from_crest_to_trough_by_its_depth():
    x = np.linspace(0.0, 1.0, 2001)
    wave = corrugation(x, wavelength=0.05, depth=8e-5, phase=math.pi / 2)
    assert wave[0] == 4e-5
    assert np.ptp(wave) == pytest.approx(8e-5, rel=1e-12)
    assert corrugation(x + 0.05, wavelength=0.05, depth=8e-5) == pytest.approx(
        corrugation(x, wavelength=0.05, depth=8e-5), abs=1e-17
    )


def test_a_level_is_that_of_the_rms():
    angle = 2 * np.pi * np.arange(1000) / 1000
    wave = polygon(angle, order=7, amplitude=amplitude_of(20.0), phase=0.3)
    assert np.sqrt(np.mean(wave**2)) == pytest.approx(1e-5, rel=1e-12)
    lines = abs(np.fft.rfft(wave))
    assert int(np.argmax(lines)) == 7


def test_a_dent_lies_at_its_angle_across_the_zero_mark_too():
    angle = 2 * np.pi * np.arange(20_000) / 20_000
    for centre in (0.0, 1.0, -0.01):
        drop = dent(
            angle, centre=centre, length=0.06, depth=1e-3, shape="parabola", rolled=False,
            radius=RADIUS,
        )  # fmt: skip
        middle = np.angle(np.sum(drop * np.exp(1j * angle)))
        assert middle == pytest.approx(centre, abs=1e-6)
        # the area under a parabola
        assert drop.sum() * 2 * np.pi * RADIUS / 20_000 == pytest.approx(2 / 3 * 6e-5, rel=1e-5)


def test_a_wheel_rolls_over_a_short_deep_spall_and_hardly_drops():
    """Its edges carry the wheel: the chord of 30 mm is L2 / 8 R = 0.25 mm high."""
    angle = 2 * np.pi * np.arange(20_000) / 20_000
    spall = {"centre": 0.0, "length": 0.03, "depth": 2e-3, "shape": "parabola", "radius": RADIUS}
    assert dent(angle, **spall, rolled=False).max() == 2e-3
    rolled = dent(angle, **spall, rolled=True).max()
    assert rolled == pytest.approx(0.03**2 / (8 * RADIUS), rel=1e-3)


def test_a_dent_larger_than_its_wheel_is_refused():
    with pytest.raises(ValueError, match="must fit on its wheel"):
        dent(
            np.zeros(3), centre=0.0, length=4.0, depth=1e-3, shape="cusp", rolled=False,
            radius=RADIUS,
        )  # fmt: skip


def test_an_onset_has_two_continuous_derivatives():
    x = np.linspace(-1.0, 3.0, 4001)
    values = onset(x, 2.0)
    assert values[[0, 1000, 2000, 3000, 4000]] == pytest.approx([0, 0, 0.5, 1, 1], abs=1e-15)
    second = np.diff(values, 2) / 1e-6
    # 60 / L^2 (a - 3 a^2 + 2 a^3): at most 5.77 / L^2, without jumps
    assert abs(second).max() == pytest.approx(5.7735 / 4.0, rel=1e-3)
    assert abs(np.diff(second)).max() < 0.01 * abs(second).max()


def test_a_sudden_onset():
    assert onset(np.array([-1e-9, 0.0, 1.0]), 0.0).tolist() == [0.0, 1.0, 1.0]


def test_a_stretch_is_whole_inside_and_nothing_outside():
    x = np.array([0.9, 1.0, 1.5, 2.0, 2.5, 3.0, 3.1])
    window = stretch(x, begin=1.0, end=3.0, taper=0.5)
    assert window.tolist() == [0.0, 0.0, 1.0, 1.0, 1.0, 0.0, 0.0]
    assert stretch(x, begin=None, end=None, taper=0.5).tolist() == [1.0] * 7
