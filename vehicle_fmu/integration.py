"""Motion of one wheel over one step: Runge-Kutta-Nystroem of order 4 with equal substeps."""

import math

from .contact import hertz_force

_ROUNDING = 1e-9
"""A step of exactly n longest substeps takes n of them, whatever the rounding of the quotient."""

MOST_SUBSTEPS = 1e5
"""Of a step: 2 s with the usual substep, the way of a whole passage."""


def require_substeps(step_size: float, longest: float) -> None:
    """Raise ValueError if a step [s] takes more than `MOST_SUBSTEPS` of the longest length [s]."""
    if step_size / longest > MOST_SUBSTEPS:
        raise ValueError(
            f"a step of {step_size:g} s is more than {MOST_SUBSTEPS:g} substeps of "
            f"{longest:g} s; use a shorter step"
        )


def substeps_of(duration: float, longest: float) -> int:
    """Return the number of equal substeps of a duration [s], none above the longest [s]."""
    return max(1, math.ceil(duration / longest * (1.0 - _ROUNDING)))


def integrate_wheel(
    displacement: float,
    velocity: float,
    surface: list[float],
    *,
    step_size: float,
    mass: float,
    load: float,
    coefficient: float,
) -> tuple[float, float]:
    """Integrate m z'' = P - C_H max(0, z - w(t))^1.5 over one step.

    The right-hand side does not depend on the velocity, so three stages give order 4 (Nystroem's
    classical method). They lie at the start, middle and end of a substep h:

        k1 = f(t,       z)
        k2 = f(t + h/2, z + h/2 v + h^2/8 k1)
        k3 = f(t + h,   z + h   v + h^2/2 k2)
        z += h v + h^2/6 (k1 + 2 k2)
        v += h/6 (k1 + 4 k2 + k3)

    Parameters
    ----------
    displacement, velocity : float
        z [m] and z' [m/s] at the start, positive downwards.
    surface : list of float, length 2 n + 1
        Level w of the surface the wheel meets [m], positive downwards, at the start, middle and
        end of each of the n substeps.
    step_size : float
        Length of the whole step [s].
    mass, load, coefficient : float
        m [kg], P [N] and C_H [N/m^1.5].

    Returns
    -------
    tuple of float
        z and z' at the end of the step.
    """
    substeps = len(surface) // 2
    h = step_size / substeps
    z, v = displacement, velocity
    w_end = surface[0]
    for k in range(substeps):
        w_start, w_middle, w_end = w_end, surface[2 * k + 1], surface[2 * k + 2]
        k1 = (load - hertz_force(z - w_start, coefficient)) / mass
        z2 = z + 0.5 * h * (v + 0.25 * h * k1)
        k2 = (load - hertz_force(z2 - w_middle, coefficient)) / mass
        z3 = z + h * (v + 0.5 * h * k2)
        k3 = (load - hertz_force(z3 - w_end, coefficient)) / mass
        z += h * (v + h / 6.0 * (k1 + 2.0 * k2))
        v += h / 6.0 * (k1 + 4.0 * k2 + k3)
    return z, v
