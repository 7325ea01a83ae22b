"""The vehicle: wheels that roll along a moving rail, each in Hertzian contact with it."""

import math
from collections.abc import Sequence

import numpy as np

from .contact import hertz_compression
from .excitation import Excitation
from .integration import integrate_wheel, require_substeps
from .irregularity import RailIrregularity
from .out_of_roundness import OutOfRoundness
from .parameters import FlatParameters, VehicleParameters
from .rolling_wheels import RollingWheels
from .running_surface import checked_rail_displacement, surface_over_step
from .speed import SpeedLaw
from .surfaces import check_out_of_roundness
from .validation import FloatArray, require_position, require_step
from .wheel_profile import WheelProfileTable, check_flat

INSTANT = 1e-6  # s, over which the rate of a surface is taken at the start


class VehicleModel(RollingWheels):
    """Rigid masses on Hertzian contacts, moving along a rail of given displacement.

    For each wheel, with z positive downwards [Nielsen & Oscarsson (2004), section 4]:

        m z'' = P - F,   F = C_H max(0, delta)^1.5,   delta = z - u - p(x) - r(x)

    u is the displacement of the rail under the wheel (the input), p the drop of the tread, r that
    of the railhead, x the position of the wheel. Given u, the wheels are independent.

    Parameters
    ----------
    parameters : VehicleParameters
        Masses, loads, geometry, accuracy.
    flat : FlatParameters
        The flat on one of the wheels.
    speed : ConstantSpeed or SpeedTable
        The motion along the rail.
    flat_table : WheelProfileTable, optional
        The measured profile of a flat of shape "table".
    irregularity : RailIrregularity, optional
        The railhead's irregularity; a perfect rail without.
    out_of_roundness : sequence of OutOfRoundness or None, optional
        Of every wheel, None for a round one; all are round without. Angle zero meets the rail
        where the centre of the flat does.

    Raises
    ------
    ValueError
        If the flat is on no wheel of this vehicle, does not fit on the wheel, its shape and
        table do not go together, or the number of tables is not that of the wheels.

    Notes
    -----
    `initialise`, or setting a saved `state`, comes before everything else. A call that raises
    leaves the model as it was.
    """

    def __init__(
        self,
        parameters: VehicleParameters,
        *,
        flat: FlatParameters,
        speed: SpeedLaw,
        flat_table: WheelProfileTable | None = None,
        irregularity: RailIrregularity | None = None,
        out_of_roundness: Sequence[OutOfRoundness | None] = (),
    ) -> None:
        check_flat(flat, flat_table, radius=parameters.wheel_radius, wheels=parameters.wheels)
        check_out_of_roundness(out_of_roundness, wheels=parameters.wheels)
        excitation = Excitation(
            parameters,
            flat=flat,
            flat_table=flat_table,
            irregularity=irregularity,
            out_of_roundness=out_of_roundness,
            speed=speed,
        )
        super().__init__(parameters, excitation)
        self._bodies: list[float] = []  # what a `SuspendedVehicle` has besides its wheels

    def initialise(self, time: float, rail_displacement: FloatArray | None = None) -> None:
        """Put every wheel in static equilibrium at its start position.

        It moves as the surface under it rises or falls there: at rest where this is smooth. The
        displacement of the rail counts as one that stays.

        To be called again whenever the rail displacement changes before the first step.

        Parameters
        ----------
        time : float
            Start time [s]; wheel 1 is at `initial_position` then.
        rail_displacement : ndarray, shape (wheels,), optional
            Displacement of the rail under each wheel [m], positive downwards; zero without.

        Raises
        ------
        ValueError
            If the time or a displacement is not finite, or their number is not that of wheels.
        """
        if not math.isfinite(time):
            raise ValueError(f"the start time is {time:g} s; it must be a finite number")
        wheels = self.parameters.wheels
        rail = checked_rail_displacement(
            np.zeros(wheels) if rail_displacement is None else rail_displacement, wheels
        )
        drops = self._excitation.drops(time, time)
        levels = [u + drop for u, drop in zip(rail, drops, strict=True)]
        displacement = self._put(levels, time)
        rates = self._excitation.rates(time, INSTANT)
        self._start = time
        self._accept(time, displacement, rates, rail, drops)

    def step(
        self, time: float, step_size: float, rail_displacement: FloatArray, *, linear: bool
    ) -> None:
        """Move on by one step.

        Parameters
        ----------
        time : float
            Start of the step [s], the end of the last one.
        step_size : float
            Its length [s]; the integration divides it as finely as it needs.
        rail_displacement : ndarray, shape (wheels,)
            Displacement of the rail under each wheel [m], positive downwards.
        linear : bool
            The displacement is that at the end of the step, reached on a straight line from the
            last one; else it is held over the whole step.

        Raises
        ------
        ValueError
            If a displacement is not finite or drives a wheel out of the range of numbers, their
            number is not that of wheels, `time` is not where the model is, or `step_size` is not
            finite and above zero, too small to move the time on, or more than
            `integration.MOST_SUBSTEPS`.
        """
        self._check_step(time, step_size)
        rail = checked_rail_displacement(rail_displacement, self.parameters.wheels)
        drops = self._excitation.drops_over_step(self._start, time, step_size)
        before = self._rail if linear else rail
        levels = [
            surface_over_step(start, end, row)
            for start, end, row in zip(before, rail, drops, strict=True)
        ]
        z, v = self._move(levels, step_size, rail)
        self._accept(time + step_size, z, v, rail, [row[-1] for row in drops])

    def _put(self, levels: list[float], time: float) -> list[float]:
        """Return where the wheels rest on surfaces of these levels [m], at the start time [s]."""
        del time  # matters to bodies above the wheels
        delta = hertz_compression(
            self.parameters.static_wheel_load, self.parameters.hertz_coefficient
        )
        return [level + delta for level in levels]

    def _move(
        self, levels: list[list[float]], step_size: float, rail: list[float]
    ) -> tuple[list[float], list[float]]:
        """Return where and how fast the wheels are [m], [m/s] when the surfaces have moved so."""
        moved = [
            integrate_wheel(
                self._displacement[i],
                self._velocity[i],
                level,
                step_size=step_size,
                mass=self.parameters.wheel_mass,
                load=self.parameters.static_wheel_load,
                coefficient=self.parameters.hertz_coefficient,
            )
            for i, level in enumerate(levels)
        ]
        z, v = zip(*moved, strict=True)
        check_motion(z, v, rail)
        return [*z], [*v]

    @property
    def state(self) -> FloatArray:
        """The complete state, shape (2 + 3 wheels,), as a copy.

        Start time and time [s], displacement [m] and velocity [m/s] of every wheel, and the last
        rail displacement under every wheel [m]; the bodies of a `SuspendedVehicle` come behind.
        Setting it restores every output bit for bit.

        Raises
        ------
        RuntimeError
            On reading, if the model was never initialised.
        ValueError
            On setting, if the length is wrong or a value is not finite.
        """
        self._require_started()
        wheels = [*self._displacement, *self._velocity, *self._rail]
        return np.array([self._start, self._time, *wheels, *self._bodies])

    @state.setter
    def state(self, state: FloatArray) -> None:
        n = self.parameters.wheels
        count = 2 + 3 * n
        if state.shape != (count + len(self._bodies),):
            raise ValueError(
                f"the state has shape {state.shape}; that of {n} wheels has "
                f"{(count + len(self._bodies),)}"
            )
        values: list[float] = state.tolist()
        if not all(map(math.isfinite, values)):
            raise ValueError("the state holds a NaN or infinity; it is not one this model saved")
        start, time, *wheels = values[:count]
        drops = self._excitation.drops(start, time)
        self._start = start
        self._bodies = values[count:]
        self._accept(time, wheels[:n], wheels[n : 2 * n], wheels[2 * n :], drops)

    def _check_step(self, time: float, step_size: float) -> None:
        """Refuse a step that does not join the last one or has no proper length."""
        self._require_started()
        require_step(time, step_size, reached=self._time, what="vehicle is")
        require_substeps(step_size, self.parameters.substep)
        end = time + step_size
        require_position(self._excitation.positions(self._start, end)[0], end)


def check_motion(
    displacement: Sequence[float], velocity: Sequence[float], rail: Sequence[float]
) -> None:
    """Raise ValueError unless the motion of every wheel is one of finite numbers."""
    for i, (z, v) in enumerate(zip(displacement, velocity, strict=True)):
        if not (math.isfinite(z) and math.isfinite(v)):
            raise ValueError(
                f"the rail displacement of {rail[i]:g} m under wheel {i + 1} drives the wheel "
                f"to {z:g} m at {v:g} m/s; give a smaller one or a shorter step"
            )
