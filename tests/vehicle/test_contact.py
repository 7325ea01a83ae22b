import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from vehicle_fmu.contact import hertz_compression, hertz_force, hertz_stiffness
from vehicle_fmu.hertz_coefficient import hertz_coefficient

C = 9.17e10
EPS = 2.0**-52


@given(st.floats(1e-9, 1e-2))
def test_force_follows_the_power_law(delta):
    # A product and a root against a power: a few roundings.
    assert hertz_force(delta, C) == pytest.approx(C * delta**1.5, rel=8 * EPS)


@given(st.floats(-1.0, 0.0))
def test_no_force_without_compression(delta):
    assert hertz_force(delta, C) == 0.0


def test_nan_compression_is_not_taken_for_loss_of_contact():
    assert math.isnan(hertz_force(math.nan, C))


@given(st.floats(1.0, 1e7))
def test_compression_inverts_force(force):
    assert hertz_force(hertz_compression(force, C), C) == pytest.approx(force, rel=16 * EPS)


@given(st.floats(1e3, 1e6))
def test_stiffness_is_the_derivative_of_the_force(force):
    delta = hertz_compression(force, C)
    h = 1e-4 * delta
    slope = (hertz_force(delta + h, C) - hertz_force(delta - h, C)) / (2.0 * h)
    # Central difference: relative error (h / delta)^2 / 24, 4e-10, and rounding, eps / 1e-4.
    assert hertz_stiffness(force, C) == pytest.approx(slope, rel=1e-8)


def test_coefficient_of_the_demonstration_example():
    # Nielsen & Oscarsson (2004), section 4, state 9.17e10 for these radii; 9.18e10 for this steel.
    coefficient = hertz_coefficient(wheel_radius=0.45, rail_radius=0.30)
    assert coefficient == pytest.approx(9.18e10, rel=5e-4)


@given(st.floats(1e-3, 10.0))
def test_equal_radii_touch_like_a_sphere_on_a_plane(radius):
    modulus = 206e9 / (2.0 * (1.0 - 0.3**2))
    coefficient = hertz_coefficient(wheel_radius=radius, rail_radius=radius)
    # The axis ratio is found to 1e-14, the integrals are good to a few eps.
    assert coefficient == pytest.approx(4.0 / 3.0 * modulus * math.sqrt(radius), rel=1e-12)


@given(st.floats(0.01, 10.0), st.floats(0.01, 10.0))
def test_coefficient_does_not_care_which_body_is_which(r1, r2):
    assert hertz_coefficient(wheel_radius=r1, rail_radius=r2) == hertz_coefficient(
        wheel_radius=r2, rail_radius=r1
    )


@pytest.mark.parametrize("axis_ratio", [1.05, 1.5, 4.0, 30.0])
def test_coefficient_matches_hertz_integrals_by_quadrature(axis_ratio):
    # Hertz's integrals over the confocal ellipsoids, for semi-axes a = 1 and b = 1 / axis_ratio:
    # with w = lambda, the curvatures are proportional to the integrals of 1/((a^2 + w) S) and
    # 1/((b^2 + w) S), the approach to that of 1/S, S = sqrt((a^2 + w)(b^2 + w) w). w = x^2.
    b2 = axis_ratio**-2

    def integral(p, q):
        return quad(lambda x: 2.0 * (1.0 + x * x) ** -p * (b2 + x * x) ** -q, 0.0, math.inf)[0]

    approach, longitudinal, transverse = integral(0.5, 0.5), integral(1.5, 0.5), integral(0.5, 1.5)
    modulus = 100e9 / (2.0 * (1.0 - 0.25**2))
    # delta - x^2/(2 r') - y^2/(2 r'') = 3 F / (4 pi E*) [I0 - I1 x^2 - I2 y^2]
    force = 1000.0
    scale = 3.0 * force / (4.0 * math.pi * modulus)
    radii = 1.0 / (2.0 * scale * longitudinal), 1.0 / (2.0 * scale * transverse)
    coefficient = hertz_coefficient(
        wheel_radius=radii[0], rail_radius=radii[1], youngs_modulus=100e9, poissons_ratio=0.25
    )
    # quad's default tolerance is 1.5e-8.
    assert coefficient == pytest.approx(force / (scale * approach) ** 1.5, rel=1e-7)


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [
        ({"wheel_radius": 0.0}, "wheel_radius is 0 m"),
        ({"rail_radius": -0.3}, "rail_radius is -0.3 m"),
        ({"youngs_modulus": math.nan}, "youngs_modulus is nan Pa"),
        ({"poissons_ratio": 0.6}, r"poissons_ratio is 0.6; it must be in 0 to 0.5"),
        ({"wheel_radius": 1e20}, "the contact is a line"),
    ],
)
def test_impossible_bodies_are_refused(wrong, sentence):
    with pytest.raises(ValueError, match=sentence):
        hertz_coefficient(**{"wheel_radius": 0.45, "rail_radius": 0.3, **wrong})
