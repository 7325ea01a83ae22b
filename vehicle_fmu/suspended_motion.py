"""Motion of the suspended vehicle: Runge-Kutta-Nystroem of order 4 for forces that damp."""

from collections.abc import Callable
from typing import TypeAlias

from .suspension import Suspension
from .validation import FloatArray

Push: TypeAlias = Callable[[int, FloatArray], FloatArray]
"""Static load minus contact force of every wheel [N], at the k-th half substep of a step and for
displacements of the wheels [m]; all of shape (wheels,)."""


def advance(
    suspension: Suspension,
    q: FloatArray,
    v: FloatArray,
    *,
    duration: float,
    substeps: int,
    push: Push,
) -> tuple[FloatArray, FloatArray]:
    """Integrate q'' = a(t, q, q') over a time.

    Nystroem's method of order 4 for forces that depend on the velocity, over a substep h:

        k1 = a(t,       q,                    v)
        k2 = a(t + h/2, q + h/2 v + h^2/8 k1, v + h/2 k1)
        k3 = a(t + h/2, q + h/2 v + h^2/8 k1, v + h/2 k2)
        k4 = a(t + h,   q + h   v + h^2/2 k3, v + h   k3)
        q += h v + h^2/6 (k1 + k2 + k3)
        v += h/6 (k1 + 2 k2 + 2 k3 + k4)

    Without dampers k2 and k3 are the same, and the method is that of `integration`.

    Parameters
    ----------
    suspension : Suspension
        Gives the accelerations.
    q, v : ndarray, shape (coordinates,)
        Coordinates and their rates at the start.
    duration : float
        Time to integrate over [s].
    substeps : int
        Number of equal substeps.
    push : callable
        What pushes the wheels; asked for k = 0 to 2 substeps.

    Returns
    -------
    tuple of ndarray
        Coordinates and rates at the end.
    """
    h = duration / substeps
    wheels = slice(0, suspension.wheels)
    for k in range(0, 2 * substeps, 2):
        k1 = suspension.acceleration(q, v, push(k, q[wheels]))
        middle = q + 0.5 * h * (v + 0.25 * h * k1)
        pushed = push(k + 1, middle[wheels])
        k2 = suspension.acceleration(middle, v + 0.5 * h * k1, pushed)
        k3 = suspension.acceleration(middle, v + 0.5 * h * k2, pushed)
        end = q + h * (v + 0.5 * h * k3)
        k4 = suspension.acceleration(end, v + h * k3, push(k + 2, end[wheels]))
        q = q + h * (v + h / 6.0 * (k1 + k2 + k3))
        v = v + h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4)
    return q, v
