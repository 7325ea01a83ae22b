import numpy as np
import pytest
from scipy.linalg import eigh

from track_fmu.beam_element import (
    BeamSection,
    deflection_shape,
    deflection_slope,
    mass_matrix,
    rotation_shape,
    shear_parameter,
    stiffness_matrix,
)

UIC60 = BeamSection(
    bending_stiffness=6.4e6,
    shear_stiffness=250e6,
    mass_per_length=60.0,
    rotary_inertia_per_length=0.24,
)


def assembled(count, length):
    size = length / count
    stiffness = np.zeros((2 * count + 2, 2 * count + 2))
    mass = np.zeros_like(stiffness)
    for e in range(count):
        part = slice(2 * e, 2 * e + 4)
        stiffness[part, part] += stiffness_matrix(UIC60, size)
        mass[part, part] += mass_matrix(UIC60, size)
    return stiffness, mass


def test_an_eighth_of_a_bay_is_dominated_by_shear():
    assert shear_parameter(UIC60, 0.65 / 8) == pytest.approx(46.5, abs=0.05)


@pytest.mark.parametrize("count", [1, 2, 7])
def test_cantilever_deflection_is_exact_for_any_number_of_elements(count):
    length, force = 0.65, 1e4
    stiffness, _ = assembled(count, length)
    load = np.zeros(2 * count)
    load[-2] = force
    tip = np.linalg.solve(stiffness[2:, 2:], load)[-2:]
    bending, shear = force * length**3 / (3 * 6.4e6), force * length / 250e6
    assert tip[0] == pytest.approx(bending + shear, rel=1e-11)
    assert tip[1] == pytest.approx(force * length**2 / (2 * 6.4e6), rel=1e-11)


def test_shapes_interpolate_their_nodes_and_hold_rigid_motion():
    length = 0.08125
    phi = shear_parameter(UIC60, length)
    for xi, node in ((0.0, 0), (1.0, 2)):
        assert deflection_shape(xi, length, phi) == pytest.approx(np.eye(4)[node], abs=1e-15)
        assert rotation_shape(xi, length, phi) == pytest.approx(np.eye(4)[node + 1], abs=1e-15)
    tilt = np.array([0.0, 1.0, length, 1.0])  # w = x, theta = 1
    for xi in np.linspace(0.0, 1.0, 7):
        assert deflection_shape(xi, length, phi) @ tilt == pytest.approx(xi * length, abs=1e-15)
        assert rotation_shape(xi, length, phi) @ tilt == pytest.approx(1.0, abs=1e-14)


def test_shapes_satisfy_the_static_beam_equations():
    """Constant shear force Q = kAG (w' - theta) = EI theta'' along the element, for every node."""
    length, step = 0.4, 1e-4
    phi = shear_parameter(UIC60, length)
    for xi in (0.2, 0.5, 0.9):
        slope = deflection_slope(xi, length, phi)
        shear = 250e6 * (slope - rotation_shape(xi, length, phi))
        ahead, here, behind = (rotation_shape(xi + d, length, phi) for d in (step, 0.0, -step))
        curvature_slope = (ahead - 2 * here + behind) / (step * length) ** 2
        # the second difference of a quadratic is exact up to rounding, 1e-16 / (4e-5)^2
        assert shear == pytest.approx(-6.4e6 * curvature_slope, rel=1e-4, abs=1e3)


def test_slope_is_the_derivative_of_the_deflection():
    length, step = 0.3, 1e-5
    phi = shear_parameter(UIC60, length)
    for xi in (0.1, 0.6):
        ahead, behind = (deflection_shape(xi + d, length, phi) for d in (step, -step))
        difference = (ahead - behind) / (2 * step * length)
        assert deflection_slope(xi, length, phi) == pytest.approx(difference, abs=1e-8)


def test_stiffness_has_no_force_in_rigid_motion_and_mass_the_right_total():
    length = 0.5
    stiffness, mass = stiffness_matrix(UIC60, length), mass_matrix(UIC60, length)
    rise, tilt = np.array([1.0, 0.0, 1.0, 0.0]), np.array([0.0, 1.0, length, 1.0])
    assert np.abs(stiffness @ np.array([rise, tilt]).T).max() < 1e-6 * np.abs(stiffness).max()
    assert rise @ mass @ rise == pytest.approx(60.0 * length, rel=1e-13)
    turned = 60.0 * length**3 / 3 + 0.24 * length  # translation and rotary inertia
    assert tilt @ mass @ tilt == pytest.approx(turned, rel=1e-13)


def exact_pinned_frequency(length, half_waves):
    """Lower root of the Timoshenko frequency equation of a simply supported beam [rad/s]."""
    k = half_waves * np.pi / length
    m, j, bending, shear = 60.0, 0.24, 6.4e6, 250e6
    a, b, c = m * j / shear, m + k**2 * (j + m * bending / shear), bending * k**4
    return np.sqrt((b - np.sqrt(b * b - 4 * a * c)) / (2 * a))


def test_frequencies_converge_with_the_square_of_the_element_length():
    """Static-exact shapes make the stiffness exact and leave an O(h^2) error in the inertia."""
    length, errors = 2.6, []
    for count in (16, 32, 64):
        stiffness, mass = assembled(count, length)
        free = np.delete(np.arange(2 * count + 2), [0, 2 * count])
        squares = eigh(stiffness[np.ix_(free, free)], mass[np.ix_(free, free)], eigvals_only=True)
        exact = exact_pinned_frequency(length, 3)
        errors.append(abs(np.sqrt(squares[2]) / exact - 1.0))
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders == pytest.approx([2.0, 2.0], abs=0.1)
    assert errors[-1] < 1e-3
