"""The size of the contact patch of wheel and rail."""

import math

from scipy.special import elliprd

from .hertz_coefficient import effective_modulus, squared_axis_ratio
from .validation import require_positive


def patch_semi_axis(
    *,
    force: float,
    wheel_radius: float,
    rail_radius: float,
    youngs_modulus: float = 206e9,
    poissons_ratio: float = 0.3,
) -> float:
    r"""Return half the length of the contact patch along the rail [m].

    With the names of `hertz_coefficient`, the longer semi-axis of Hertz's ellipse, which lies
    along the larger radius, and from it the other one, are

    .. math:: a^3 = \frac{F r' R_D(0, q, 1)}{\pi E^*}, \qquad b = a \sqrt{q}

    which is K. L. Johnson, Contact Mechanics (1985), Eq. (4.26), and for a ball on a plane
    a^3 = 3 F r' / (4 E*).

    Parameters
    ----------
    force : float
        Contact force F [N].
    wheel_radius, rail_radius, youngs_modulus, poissons_ratio : float
        As for `hertz_coefficient`.

    Raises
    ------
    ValueError
        If the force is not positive and finite, or as `hertz_coefficient`.
    """
    require_positive("contact force", force, "N", "give the static wheel load")
    q = squared_axis_ratio(wheel_radius, rail_radius)
    modulus = effective_modulus(youngs_modulus, poissons_ratio)
    large = max(wheel_radius, rail_radius)
    longer = math.cbrt(force * large * float(elliprd(0.0, q, 1.0)) / (math.pi * modulus))
    return longer if wheel_radius >= rail_radius else longer * math.sqrt(q)
