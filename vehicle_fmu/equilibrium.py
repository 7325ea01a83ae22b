"""Static equilibrium of suspended bodies on wheels that stand at different heights."""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from .suspension import Suspension
from .validation import FloatArray

Footing: TypeAlias = Callable[[FloatArray], tuple[FloatArray, FloatArray]]
"""What pushes every wheel down [N], static load minus contact force, and the stiffness of its
contact [N/m], for displacements of the wheels [m]; all of shape (wheels,)."""

TOLERANCE = 1e-12  # of the static load of a wheel
ROUNDING = 1e-15  # of the displacements; stiff treads feel it
MAX_SWEEPS = 100
OVERSHOOT = 0.1  # slope of the energy behind a change over the fall before it
SMALLEST_SHARE = 1e-3  # of a change


def follow(suspension: Suspension, wheels: FloatArray) -> FloatArray:
    """Return coordinates of bodies that ride on displaced wheels without any spring being moved.

    Bogies lie on the straight line of least squares through their wheels, the car body on that
    through the bogies' centres. With two wheels a bogie and two bogies no spring is compressed;
    with more it is a first guess. Of velocities it gives velocities.

    Parameters
    ----------
    suspension : Suspension
        How the bodies hang together.
    wheels : ndarray, shape (wheels,)
        Displacements of the wheels [m].

    Returns
    -------
    ndarray, shape (coordinates,)
        Coordinates of the suspension, those of the wheels included.
    """
    n, m = suspension.wheels, suspension.bogies
    q = np.zeros(len(suspension.inverse_mass))
    q[:n] = wheels
    if suspension.is_flexible:
        q[n : 2 * n] = wheels
    if suspension.is_suspended:
        above = 2 * n
        for j in range(m):
            own = slice(j * (n // m), (j + 1) * (n // m))
            q[[above + j, above + m + j]] = _line(suspension.levers[own], wheels[own])
        q[-2:] = _line(suspension.bogie_levers, q[above : above + m])
    return q


def _line(lever: FloatArray, displacement: FloatArray) -> tuple[float, float]:
    """Mean and slope over levers whose mean is zero; no slope where there is but one."""
    square = float(lever @ lever)
    slope = float(lever @ displacement) / square if square > 0.0 else 0.0
    return float(displacement.mean()), slope


def settle(suspension: Suspension, q: FloatArray, footing: Footing | None = None) -> FloatArray:
    """Return the coordinates at which nothing pushes any body, by Newton's iteration.

    The energy of springs, stops and contacts is convex: a change that leads beyond its lowest
    point on the way is halved.

    Parameters
    ----------
    suspension : Suspension
        Bodies, springs and stops.
    q : ndarray, shape (coordinates,)
        First guess [m], [rad]; given back as it is where it is an equilibrium.
    footing : callable, optional
        Contacts of the wheels. Without, the wheels are held where they are.

    Raises
    ------
    ValueError
        If no equilibrium is found.
    """
    miss = _missing(suspension, q, footing)
    for _ in range(MAX_SWEEPS):
        if float(np.abs(miss).max()) <= TOLERANCE * suspension.load:
            return q
        if not np.isfinite(miss).all():
            break
        try:
            change = np.linalg.solve(_stiffness(suspension, q, footing), miss)
        except np.linalg.LinAlgError:
            break  # heights beyond all numbers
        if float(np.abs(change).max()) <= ROUNDING * float(np.abs(q).max()):
            return q
        fall, share = float(change @ miss), 1.0
        while True:
            there = q + share * change
            miss = _missing(suspension, there, footing)
            if float(change @ miss) >= -OVERSHOOT * fall or share < SMALLEST_SHARE:
                break
            share *= 0.5
        q = there
    raise ValueError(
        f"the vehicle finds no static equilibrium on wheels displaced by up to "
        f"{float(np.abs(q[: suspension.wheels]).max()):g} m at the start; begin on a more even rail"
    )


def _missing(suspension: Suspension, q: FloatArray, footing: Footing | None) -> FloatArray:
    """What pushes every coordinate [N], [N m]; zero of wheels that are held."""
    n = suspension.wheels
    miss = -suspension.resistance(q)
    if footing is None:
        miss[:n] = 0.0
    else:
        miss[:n] += footing(q[:n])[0]
    return miss


def _stiffness(suspension: Suspension, q: FloatArray, footing: Footing | None) -> FloatArray:
    """How that falls with the coordinates; unity for those that nothing moves."""
    n = suspension.wheels
    matrix = suspension.stiffness(q)
    if footing is None:
        matrix[:n] = matrix[:, :n] = 0.0
    else:
        matrix[range(n), range(n)] += footing(q[:n])[1]
    free = np.flatnonzero(np.diagonal(matrix) == 0.0)
    matrix[free, free] = 1.0
    return matrix
