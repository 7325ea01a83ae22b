"""The contact patch and what it averages out."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import j1, jn_zeros

from railcosim.irregularity.contact_filter import attenuation, filter_along, filter_around
from vehicle_fmu.contact_patch import patch_semi_axis

SEMI_AXIS = 6e-3
SPACING = 5e-4


def test_short_waves_are_left_as_remington_s_patch_leaves_them_on_average():
    """(2 J1 / ka)^2 over whole lobes, of roughness that is the same across the patch: 2 %."""
    zeros = jn_zeros(1, 60)
    for first in (4, 10, 20):
        lobes = (zeros[first], zeros[first + 20])
        remington = quad(lambda k: (2 * j1(k) / k) ** 2, *lobes, limit=200)[0]
        ours = quad(lambda k: attenuation(np.array([k]), 1.0)[0] ** 2, *lobes)[0]
        assert ours == pytest.approx(remington, rel=0.02)


def test_long_waves_pass():
    assert attenuation(np.array([0.0]), SEMI_AXIS).tolist() == [1.0]
    # 2 m waves
    assert attenuation(np.array([math.pi]), SEMI_AXIS)[0] == pytest.approx(1.0, abs=1e-5)


@pytest.mark.parametrize("waves", [5, 40, 200])
def test_a_sine_around_a_wheel_is_weakened_and_not_moved(waves):
    angle = 2 * np.pi * np.arange(4000) / 4000
    sine = np.cos(waves * angle + 0.4)
    found = filter_around(sine, spacing=SPACING, semi_axis=SEMI_AXIS)
    factor = attenuation(np.array([2 * np.pi * waves / (4000 * SPACING)]), SEMI_AXIS)[0]
    assert found == pytest.approx(factor * sine, abs=1e-12)


def test_a_rail_with_ends_is_filtered_as_if_it_went_on():
    x = SPACING * np.arange(8000)
    sine = np.sin(2 * np.pi * x / 0.05)
    found = filter_along(sine, spacing=SPACING, semi_axis=SEMI_AXIS)
    factor = attenuation(np.array([2 * np.pi / 0.05]), SEMI_AXIS)[0]
    # but for ten patches at the ends, where its slope breaks off
    inner = slice(120, -120)
    assert found[inner] == pytest.approx(factor * sine[inner], abs=2e-3)


def test_a_straight_rail_stays_what_it_is():
    level = np.full(500, 3e-3)
    assert filter_along(level, spacing=SPACING, semi_axis=SEMI_AXIS) == pytest.approx(level)


def test_the_patch_of_a_ball_on_a_plane():
    modulus = 206e9 / (2 * (1 - 0.3**2))
    found = patch_semi_axis(force=1e5, wheel_radius=0.4, rail_radius=0.4)
    assert found == pytest.approx(math.cbrt(3 * 1e5 * 0.4 / (4 * modulus)), rel=1e-12)


@pytest.mark.parametrize("axis_ratio", [1.3, 3.0])
@pytest.mark.parametrize("along", [True, False])
def test_the_patch_matches_hertz_integrals_by_quadrature(axis_ratio, along):
    """Semi-axes 1 and 1 / ratio; curvatures of the gap that closes under a force over them."""
    b2 = axis_ratio**-2

    def integral(p, q):
        return quad(lambda x: 2.0 * (1.0 + x * x) ** -p * (b2 + x * x) ** -q, 0.0, math.inf)[0]

    modulus = 206e9 / (2 * (1 - 0.3**2))
    force = 1e9
    scale = 3.0 * force / (4.0 * math.pi * modulus)
    longer, shorter = (1.0 / (2.0 * scale * integral(*p)) for p in ((1.5, 0.5), (0.5, 1.5)))
    wheel, rail, axis = (longer, shorter, 1.0) if along else (shorter, longer, 1.0 / axis_ratio)
    found = patch_semi_axis(force=force, wheel_radius=wheel, rail_radius=rail)
    assert found == pytest.approx(axis, rel=1e-7)


def test_a_patch_needs_a_force():
    with pytest.raises(ValueError, match="contact force is 0 N"):
        patch_semi_axis(force=0.0, wheel_radius=0.45, rail_radius=0.3)
