"""The suspended vehicle on the rail: wheels in Hertzian contact under bogies and a car body."""

import numpy as np

from .irregularity import RailIrregularity
from .parameters import FlatParameters, VehicleParameters
from .speed import SpeedLaw
from .suspended_motion import advance
from .suspension import Suspension
from .validation import FloatArray
from .vehicle_model import VehicleModel, check_motion
from .wheel_profile import WheelProfileTable


class SuspendedVehicle(VehicleModel):
    """A `VehicleModel` whose wheels are coupled by the bodies above them.

    It starts at rest, levelled where it stands: every wheel carries its static load and every
    suspension its share of it, whatever the height of the rail under the wheels.

    Parameters
    ----------
    parameters, flat, speed, flat_table, irregularity
        As for `VehicleModel`.
    suspension : Suspension
        Of as many wheels, with the same masses and loads.

    Raises
    ------
    ValueError
        As for `VehicleModel`, or if the substep is too long for the suspension.
    """

    def __init__(
        self,
        parameters: VehicleParameters,
        *,
        flat: FlatParameters,
        speed: SpeedLaw,
        suspension: Suspension,
        flat_table: WheelProfileTable | None = None,
        irregularity: RailIrregularity | None = None,
    ) -> None:
        super().__init__(
            parameters, flat=flat, speed=speed, flat_table=flat_table, irregularity=irregularity
        )
        suspension.check_substep(parameters.substep)
        self.suspension = suspension
        # the wheels' displacements in equilibrium; coordinates behind the wheels, and their rates
        wheels, coordinates = parameters.wheels, len(suspension.inverse_mass)
        self._above = coordinates - wheels
        self._bodies = [0.0] * (wheels + 2 * self._above)

    def initialise(self, time: float, rail_displacement: FloatArray | None = None) -> None:
        """Put the vehicle at rest in static equilibrium; see `VehicleModel.initialise`."""
        super().initialise(time, rail_displacement)
        self._bodies = [*self._displacement, *([0.0] * (2 * self._above))]

    @property
    def coordinates(self) -> tuple[FloatArray, FloatArray]:
        """Coordinates of the suspension, from static equilibrium, and their rates."""
        self._require_started()
        n = self.parameters.wheels
        bodies = np.array(self._bodies)
        wheels = np.array(self._displacement) - bodies[:n]
        above = n + self._above
        return (
            np.concatenate([wheels, bodies[n:above]]),
            np.concatenate([self._velocity, bodies[above:]]),
        )

    @property
    def push(self) -> FloatArray:
        """Static load minus contact force of every wheel [N], shape (wheels,)."""
        return self.parameters.static_wheel_load - self.contact_force

    def _move(
        self, levels: list[list[float]], step_size: float, rail: list[float]
    ) -> tuple[list[float], list[float]]:
        n = self.parameters.wheels
        load, coefficient = self.parameters.static_wheel_load, self.parameters.hertz_coefficient
        surface = np.array(levels).T
        origin = np.array(self._bodies[:n])

        def push(k: int, displacement: FloatArray) -> FloatArray:
            compression = (origin + displacement) - surface[k]
            pressed = coefficient * compression * np.sqrt(np.abs(compression))
            return load - np.where(compression < 0.0, 0.0, pressed)

        with np.errstate(over="ignore", invalid="ignore"):  # what is not finite is refused below
            q, v = advance(
                self.suspension,
                *self.coordinates,
                duration=step_size,
                substeps=len(surface) // 2,
                push=push,
            )
            moved, velocity = (origin + q[:n]).tolist(), v[:n].tolist()
        check_motion(moved, velocity, rail)
        self._bodies = [*self._bodies[:n], *q[n:].tolist(), *v[n:].tolist()]
        return moved, velocity
