"""The suspended vehicle on the rail: wheels in Hertzian contact under bogies and a car body."""

from collections.abc import Sequence

import numpy as np

from .equilibrium import follow, settle
from .irregularity import RailIrregularity
from .out_of_roundness import OutOfRoundness
from .parameters import FlatParameters, VehicleParameters
from .speed import SpeedLaw
from .suspended_motion import advance
from .suspension import Suspension
from .validation import FloatArray
from .vehicle_model import VehicleModel, check_motion
from .wheel_profile import WheelProfileTable

SWAY = 1.0
"""Time over which bodies above the wheels smooth what they follow at the start [s]: about a period
of car bodies, which take no part in shorter waves."""


class SuspendedVehicle(VehicleModel):
    """A `VehicleModel` whose wheels are coupled by the bodies above them.

    It starts in static equilibrium at the height that the surface has under each wheel. Bogie
    frames and car body follow the surface as that rises or falls in the mean over `SWAY`.
    Their displacements count from static equilibrium on a level rail, the wheels' mean height.

    Parameters
    ----------
    parameters, flat, speed, flat_table, irregularity, out_of_roundness
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
        out_of_roundness: Sequence[OutOfRoundness | None] = (),
    ) -> None:
        super().__init__(
            parameters,
            flat=flat,
            speed=speed,
            flat_table=flat_table,
            irregularity=irregularity,
            out_of_roundness=out_of_roundness,
        )
        suspension.check_substep(parameters.substep)
        self.suspension = suspension
        # what the wheels' coordinates count from; coordinates behind the wheels, and their rates
        wheels, coordinates = parameters.wheels, len(suspension.inverse_mass)
        self._above = coordinates - wheels
        self._bodies = [0.0] * (wheels + 2 * self._above)

    def _put(self, levels: list[float], time: float) -> list[float]:
        z = np.array(super()._put(levels, time))
        mean = float(z.mean())

        def footing(displacement: FloatArray) -> tuple[FloatArray, FloatArray]:
            compression = np.maximum(mean + displacement - np.array(levels), 0.0)
            root = self.parameters.hertz_coefficient * np.sqrt(compression)
            return self.parameters.static_wheel_load - root * compression, 1.5 * root

        with np.errstate(over="ignore", invalid="ignore"):  # what is not finite is refused there
            q = settle(self.suspension, follow(self.suspension, z - mean), footing)
        n = self.parameters.wheels
        rates = follow(self.suspension, np.array(self._excitation.rates(time, SWAY)))
        self._bodies = [*([mean] * n), *q[n:].tolist(), *rates[n:].tolist()]
        displacement: list[float] = (mean + q[:n]).tolist()
        return displacement

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
