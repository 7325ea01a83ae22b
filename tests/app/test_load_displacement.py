"""The ballast of Fig. 7 of the paper: Eq. (26), its polynomial Eq. (27), loss factors."""

import numpy as np
import pytest
from scipy.integrate import quad

from railcosim.ballast_curves import ballast_polynomial, compute_curves, curve_numbers
from railcosim.errors import InputError
from railcosim.figures.load_displacement import draw_load_displacement
from railcosim.load_displacement import (
    Polynomial,
    SecantLaw,
    equidistant_loads,
    fit_polynomial,
    loss_factor,
    viscous_loss_factor,
)
from railcosim.scenario import Scenario
from railcosim.secant_data import SecantData
from railcosim.track_section import Track
from track_fmu.ballast import PolynomialBallast

LAW = SecantLaw()
PAPER = ballast_polynomial(Scenario().track)


def test_the_law_and_its_inverse():
    """60 kN at 150 MN/m is 0.4 mm, Eq. (26)."""
    force = np.array([0.0, 1e3, 60e3, 140e3])
    displacement = LAW.displacement(force)
    assert displacement[2] == pytest.approx(0.4e-3, rel=1e-12)
    assert LAW.force(displacement) == pytest.approx(force, rel=1e-12)
    secant = LAW.slope * force[1:] + LAW.stiffness
    assert force[1:] / displacement[1:] == pytest.approx(secant, rel=1e-12)


def test_the_papers_coefficients_come_from_ten_loads_up_to_60_kn():
    """The paper names neither its loads nor its weights; these give what it prints to two digits
    in alpha and to 0.6 and 1.6 % in beta and delta. Five kilonewtons more or less of the largest
    load move all three by 10 % or more, so it must have been about this range.
    """
    found = fit_polynomial(LAW, equidistant_loads(60e3, 10))
    assert found.alpha == pytest.approx(0.37e12, abs=0.005e12)
    assert found.beta / -2.47e15 == pytest.approx(1.0 - 0.0054, abs=1e-4)
    assert found.delta / 5.75e18 == pytest.approx(1.0 - 0.0151, abs=1e-4)
    for largest in (55e3, 65e3):
        other = fit_polynomial(LAW, equidistant_loads(largest, 10))
        for name in ("alpha", "beta", "delta"):
            assert abs(getattr(other, name) / getattr(PAPER, name) - 1.0) > 0.10


def test_the_two_polynomials_differ_by_what_rounding_does():
    """Half of the last digit of alpha, beta and delta is 0.8, 0.3 and 0.13 kN at 0.4 mm."""
    found = fit_polynomial(LAW, equidistant_loads())
    x = np.linspace(0.0, 0.4e-3, 101)
    assert np.abs(found.force(x) - PAPER.force(x)).max() < 1.4e3
    last = 0.4e-3 ** np.array([2, 3, 4]) * [0.005e12, 0.005e15, 0.005e18]
    assert last == pytest.approx([0.8e3, 0.32e3, 0.128e3], rel=1e-9)


def test_a_polynomial_of_the_same_kind_is_found_exactly():
    """Least squares of more loads than coefficients, and no slope gives no coefficients."""
    assert fit_polynomial(SecantLaw(slope=0.0), equidistant_loads()).alpha == 0.0
    loads = equidistant_loads(60e3, 3)
    assert fit_polynomial(LAW, loads).force(LAW.displacement(loads)) == pytest.approx(loads)


def test_it_is_the_least_squares_fit():
    """Any other coefficient is worse."""
    loads = equidistant_loads()
    x = LAW.displacement(loads)
    best = fit_polynomial(LAW, loads)

    def misfit(**changed):
        names = ("alpha", "beta", "delta", "stiffness")
        values = {name: getattr(best, name) for name in names}
        return np.sum((Polynomial(**{**values, **changed}).force(x) - loads) ** 2)

    for name in ("alpha", "beta", "delta"):
        for factor in (0.999, 1.001):
            assert misfit(**{name: factor * getattr(best, name)}) > misfit()


def test_the_tangent_of_the_papers_polynomial_never_falls_below_that_of_the_unloaded_ballast():
    assert PAPER.least_tangent(0.5e-3) == 30e6
    soft = Polynomial(alpha=1e11, beta=-2.47e15, delta=5.75e18, stiffness=30e6)
    x = np.linspace(0.0, 0.5e-3, 200_001)
    slope = np.min(np.diff(soft.force(x)) / np.diff(x))
    assert soft.least_tangent(0.5e-3) == pytest.approx(slope, rel=1e-5)


def test_the_polynomial_is_the_force_of_the_track_model():
    x = np.array([0.1e-3, 0.4e-3])
    increment = PolynomialBallast().force(x, np.zeros(2), np.arange(2))
    assert PAPER.force(x) == pytest.approx(30e6 * x + increment, rel=1e-12)
    assert ballast_polynomial(Track(ballast="linear")).force(x) == pytest.approx(30e6 * x)


def test_the_loss_factor_of_a_viscous_damper_is_that_of_its_loop():
    """Eq. (1) of the loop that a harmonic motion runs through, Eq. (28) of the damper: 0.39."""
    amplitude, omega = 0.2e-3, 2 * np.pi * 60.0

    def power(t):
        velocity = amplitude * omega * np.cos(omega * t)
        return 31e3 * velocity**2

    energy = quad(power, 0.0, 1.0 / 60.0)[0]
    expected = viscous_loss_factor(frequency=60.0, damping=31e3, stiffness=30e6)
    assert loss_factor(energy=energy, stiffness=30e6, displacement=amplitude) == pytest.approx(
        expected, rel=1e-9
    )
    assert expected == pytest.approx(0.39, abs=0.001)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: SecantLaw(slope=-1.0), "slope .* -1 1/m but must be from 0 to"),
        (lambda: SecantLaw(slope=float("nan")), "from 0 to 1e.09 1/m"),
        (lambda: SecantLaw(stiffness=0.0), "0 N/m but must be from 1 to"),
        (lambda: fit_polynomial(SecantLaw(slope=1e300), equidistant_loads()), "1e.300 1/m"),
        (lambda: equidistant_loads(1e300), "at most 1e.07 N"),
        (lambda: equidistant_loads(0.0), "largest load is 0 N"),
        (lambda: equidistant_loads(60e3, 2), "3 coefficients"),
        (lambda: equidistant_loads(60e3, 10**6), "choose 3 to"),
    ],
)
def test_wrong_laws_are_refused(make, message):
    with pytest.raises(InputError, match=message):
        make()


def test_the_curves_are_labelled_and_drawn():
    loads = equidistant_loads()
    curves = compute_curves(Scenario(), LAW, loads)
    assert curves["force_law"].to_numpy()[-1] == pytest.approx(60e3, rel=1e-9)
    assert curves["force_linear"].to_numpy()[-1] == pytest.approx(12e3, rel=1e-9)
    assert all(curves[name].attrs["units"] in {"N", "m"} for name in curves.variables)
    points = SecantData(force=loads, stiffness=LAW.slope * loads + LAW.stiffness)
    (axes,) = draw_load_displacement(curves, points).axes
    drawn = {line.get_label(): line for line in axes.lines}
    assert drawn["linear"].get_ydata()[-1] == pytest.approx(12.0, rel=1e-9)
    assert drawn["measured"].get_xdata() == pytest.approx(1e3 * LAW.displacement(loads))
    assert drawn["measured law, Eq. (26)"].get_ydata() == pytest.approx(1e-3 * loads)


def test_the_numbers_say_how_far_the_polynomials_are_from_the_law():
    numbers = curve_numbers(Scenario(), LAW, equidistant_loads(), 60.0)
    assert numbers["polynomial"]["largest_deviation"] == pytest.approx(1.693e3, abs=1.0)
    assert numbers["fitted"]["largest_deviation"] == pytest.approx(1.035e3, abs=1.0)
    assert numbers["loss_factor"] == pytest.approx(0.3896, abs=1e-4)
    with pytest.raises(InputError, match="--frequency is 0 Hz"):
        curve_numbers(Scenario(), LAW, equidistant_loads(), 0.0)


def test_the_secant_law_of_a_scenario_is_the_measured_one():
    """Eq. (26) with the same slope; it has no coefficients of a polynomial."""
    scenario = Scenario(track=Track(ballast="hyperbolic"))
    curves = compute_curves(scenario, LAW, equidistant_loads())
    assert "force_polynomial" not in curves
    assert curves["force_ballast"].to_numpy() == pytest.approx(
        curves["force_law"].to_numpy(), rel=1e-9, abs=1e-9
    )
    numbers = curve_numbers(scenario, LAW, equidistant_loads(), 60.0)
    assert numbers["polynomial"]["alpha"] is None
    assert numbers["polynomial"]["largest_deviation"] < 1e-6
    (axes,) = draw_load_displacement(curves).axes
    assert "the scenario's" in [line.get_label() for line in axes.lines]
