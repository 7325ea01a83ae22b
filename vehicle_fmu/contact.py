"""Hertz's law of the wheel-rail contact: force, its inverse, and its tangent."""

from math import cbrt, sqrt


def hertz_force(compression: float, coefficient: float) -> float:
    """Return the contact force F = C_H max(0, delta)^1.5 [N].

    Parameters
    ----------
    compression : float
        Approach of wheel and rail, delta [m]; negative when they are apart.
    coefficient : float
        C_H [N/m^1.5].

    Returns
    -------
    float
        Contact force, never negative: the contact cannot pull.
    """
    if compression < 0.0:
        return 0.0
    # Not a power: a square root is rounded in the same way on every machine. Not max(0, delta):
    # a NaN must stay one and not pose as loss of contact.
    return coefficient * compression * sqrt(compression)


def hertz_compression(force: float, coefficient: float) -> float:
    """Return the compression delta = (F / C_H)^(2/3) under a force F >= 0 [m]."""
    return cbrt(force / coefficient) ** 2


def hertz_stiffness(force: float, coefficient: float) -> float:
    """Return the tangent stiffness dF/d(delta) = 1.5 C_H^(2/3) F^(1/3) at a force F >= 0 [N/m]."""
    return 1.5 * cbrt(coefficient) ** 2 * cbrt(force)
