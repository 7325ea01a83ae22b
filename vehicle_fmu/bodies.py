"""What is seen of the bodies above the wheels, the same for either side of the contacts."""

from typing import Protocol

import numpy as np

from .suspension import Suspension
from .validation import FloatArray


class Suspended(Protocol):
    """What the outputs are taken from."""

    suspension: Suspension

    @property
    def coordinates(self) -> tuple[FloatArray, FloatArray]:
        """Coordinates and their rates, shape (coordinates,) each."""
        ...

    @property
    def push(self) -> FloatArray:
        """Static load minus contact force [N], shape (wheels,)."""
        ...


def observe_bodies(model: Suspended) -> dict[str, FloatArray]:
    """Return displacement, pitch, acceleration and suspension forces by the names of the outputs.

    Returns
    -------
    dict of ndarray
        ``primary_force`` [N], shape (wheels,); ``secondary_force`` [N], ``bogie_displacement`` [m],
        ``bogie_pitch`` [rad] and ``bogie_acceleration`` [m/s2], shape (bogies,);
        ``car_displacement``, ``car_pitch`` and ``car_acceleration``, shape (1,). Displacements are
        counted from static equilibrium, downwards positive, pitch nose down, forces are whole and
        in compression positive.
    """
    suspension = model.suspension
    n, m = suspension.wheels, suspension.bogies
    q, v = model.coordinates
    acceleration = suspension.acceleration(q, v, model.push)
    primary, secondary = np.split(suspension.forces(q, v), [n])
    above = 2 * n
    return {
        "primary_force": primary,
        "secondary_force": secondary,
        "bogie_displacement": q[above : above + m],
        "bogie_pitch": q[above + m : above + 2 * m],
        "bogie_acceleration": acceleration[above : above + m],
        "car_displacement": q[-2:-1],
        "car_pitch": q[-1:],
        "car_acceleration": acceleration[-2:-1],
    }
