"""What a vehicle keeps of its wheels on the rail, and what is seen of them."""

import math

import numpy as np
import numpy.typing as npt

from .contact import hertz_force
from .excitation import Excitation
from .parameters import VehicleParameters
from .validation import FloatArray


class RollingWheels:
    """Wheels on a rail of given displacement, where they are and how hard they press.

    Parameters
    ----------
    parameters : VehicleParameters
        Masses, loads, geometry.
    excitation : Excitation
        What the wheels roll over.
    """

    def __init__(self, parameters: VehicleParameters, excitation: Excitation) -> None:
        self.parameters = parameters
        self._excitation = excitation
        self._start = self._time = math.nan
        self._displacement: list[float] = []
        self._velocity: list[float] = []
        self._rail: list[float] = []
        self._compression: list[float] = []

    @property
    def position(self) -> FloatArray:
        """Position of each wheel along the rail [m], shape (wheels,)."""
        self._require_started()
        return np.array(self._excitation.positions(self._start, self._time))

    @property
    def displacement(self) -> FloatArray:
        """Displacement z of each wheel [m], positive downwards, shape (wheels,)."""
        self._require_started()
        return np.array(self._displacement)

    @property
    def velocity(self) -> FloatArray:
        """Velocity z' of each wheel [m/s], positive downwards, shape (wheels,)."""
        self._require_started()
        return np.array(self._velocity)

    @property
    def gap(self) -> FloatArray:
        """Gap -delta between each wheel and the rail [m], positive apart, shape (wheels,)."""
        self._require_started()
        return -np.array(self._compression)

    @property
    def contact_force(self) -> FloatArray:
        """Force F in each contact [N], positive in compression, never negative, shape (wheels,)."""
        self._require_started()
        coefficient = self.parameters.hertz_coefficient
        return np.array([hertz_force(delta, coefficient) for delta in self._compression])

    @property
    def in_contact(self) -> npt.NDArray[np.bool_]:
        """Whether each wheel presses on the rail, shape (wheels,)."""
        self._require_started()
        return np.array([delta > 0.0 for delta in self._compression])

    def _accept(
        self,
        time: float,
        displacement: list[float],
        velocity: list[float],
        rail: list[float],
        drops: list[float],
    ) -> None:
        """Take over a state and derive from it, always in the same way, what the outputs need."""
        self._time = time
        self._displacement = displacement
        self._velocity = velocity
        self._rail = rail
        self._compression = [
            z - (u + drop) for z, u, drop in zip(displacement, rail, drops, strict=True)
        ]

    def _require_started(self) -> None:
        if not self._displacement:
            raise RuntimeError("the vehicle has no state yet: call initialise first")
