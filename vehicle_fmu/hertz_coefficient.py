"""The coefficient of Hertz's law from the radii of wheel and rail: the exact elliptic contact."""

import math

from scipy.optimize import brentq
from scipy.special import elliprd, elliprf

from .validation import require_positive

# Squared ratio of the semi-axes. 1e-14 is a contact patch ten million times longer than wide.
_LEAST_SQUARED_RATIO = 1e-14


def hertz_coefficient(
    *,
    wheel_radius: float,
    rail_radius: float,
    youngs_modulus: float = 206e9,
    poissons_ratio: float = 0.3,
) -> float:
    r"""Return C_H in F = C_H delta^1.5 for a wheel of straight profile on a rail [N/m^1.5].

    The wheel is curved along the rail only, the railhead across it only, and both are of the same
    material. With the semi-axes a >= b of the contact ellipse, q = (b/a)^2, the relative
    curvatures 1/r' <= 1/r'' and Carlson's integrals R_F and R_D,

    .. math::

        \frac{r'}{r''} = \frac{R_D(0, 1, q)}{R_D(0, q, 1)}, \qquad
        C_H = \frac{2 \pi E^*}{3}\,R_F(0, q, 1)^{-3/2}\sqrt{\tfrac{2}{3} r' R_D(0, q, 1)}

    which is K. L. Johnson, Contact Mechanics (1985), Eqs. (4.24)-(4.26), with the complete
    elliptic integrals written so that no digit cancels near the circle.

    Parameters
    ----------
    wheel_radius : float
        Rolling radius of the wheel [m].
    rail_radius : float
        Transverse radius of the railhead [m].
    youngs_modulus : float
        E of wheel and rail [Pa].
    poissons_ratio : float
        nu of wheel and rail.

    Raises
    ------
    ValueError
        If a radius or E is not positive and finite, nu is outside [0, 0.5], or the radii are so
        far apart that the contact is a line.
    """
    q = squared_axis_ratio(wheel_radius, rail_radius)
    modulus = effective_modulus(youngs_modulus, poissons_ratio)
    large = max(wheel_radius, rail_radius)
    return float(
        2.0
        * math.pi
        * modulus
        / 3.0
        * elliprf(0.0, q, 1.0) ** -1.5
        * math.sqrt(2.0 / 3.0 * large * elliprd(0.0, q, 1.0))
    )


def effective_modulus(youngs_modulus: float, poissons_ratio: float) -> float:
    """Return E* = E / (2 (1 - nu^2)) of two bodies of the same material [Pa]."""
    require_positive("youngs_modulus", youngs_modulus, "Pa", "206e9 for steel")
    if not 0.0 <= poissons_ratio <= 0.5:
        raise ValueError(
            f"poissons_ratio is {poissons_ratio:g}; it must be in 0 to 0.5: 0.3 for steel"
        )
    return youngs_modulus / (2.0 * (1.0 - poissons_ratio**2))


def squared_axis_ratio(wheel_radius: float, rail_radius: float) -> float:
    """Return q = (b/a)^2 <= 1 of the contact ellipse of a wheel and a rail of these radii [m]."""
    require_positive("wheel_radius", wheel_radius, "m", "give half the wheel diameter")
    require_positive("rail_radius", rail_radius, "m", "0.3 for a UIC60 railhead")
    curvature_ratio = max(wheel_radius, rail_radius) / min(wheel_radius, rail_radius)

    def mismatch(log_q: float) -> float:
        q = math.exp(log_q)
        return float(math.log(elliprd(0.0, 1.0, q) / elliprd(0.0, q, 1.0) / curvature_ratio))

    least = math.log(_LEAST_SQUARED_RATIO)
    if mismatch(least) < 0.0:
        raise ValueError(
            f"wheel and rail radius differ by the factor {curvature_ratio:g}; the contact is a "
            "line and has no Hertz coefficient: give radii of similar size"
        )
    return math.exp(float(brentq(mismatch, least, 0.0, xtol=1e-15, rtol=1e-14)))
