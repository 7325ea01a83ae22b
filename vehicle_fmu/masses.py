"""Rigid wheel masses under their loads, pressed up by given contact forces."""

import math
from dataclasses import dataclass

import numpy as np

from .speed import SpeedLaw
from .standing import Standing, level
from .validation import (
    FloatArray,
    check_offsets,
    require_finite,
    require_position,
    require_positive,
    require_step,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class MassesParameters:
    """Equal, independent wheel masses in any number of bogies.

    Attributes
    ----------
    offsets : tuple of float
        How far each wheel runs behind wheel 1 [m], wheel 1 included, which has 0.
    wheel_mass : float
        Mass moving with each wheel, half the unsprung mass of a wheelset [kg].
    static_wheel_load : float
        Total static wheel-rail force, the only weight in the model [N].
    initial_position : float
        Position of wheel 1 along the rail at the start [m].

    Raises
    ------
    ValueError
        If there is no wheel, a value is not finite or outside its range.
    """

    offsets: tuple[float, ...] = (0.0, 1.8)
    wheel_mass: float = 592.5
    static_wheel_load: float = 117_720.0
    initial_position: float = 12.7

    def __post_init__(self) -> None:
        check_offsets(self.offsets)
        require_positive(
            "wheel_mass", self.wheel_mass, "kg", "give half the unsprung mass of a wheelset"
        )
        require_positive(
            "static_wheel_load", self.static_wheel_load, "N", "give half the axle load as a force"
        )
        require_finite("initial_position", self.initial_position, "m", "give the start of wheel 1")


class Masses:
    """Free wheel masses, ``m z'' = P - F``, with the displacement counted from static equilibrium.

    The contact force ``F`` runs on straight lines between the times at which it is known, on
    which the motion is integrated exactly. Where it is known at the start of a step only, its last
    line is continued for the outputs; the next force given replaces what was guessed.

    Parameters
    ----------
    parameters : MassesParameters
        Masses, loads, geometry.
    speed : ConstantSpeed or SpeedTable
        The motion along the rail.

    Notes
    -----
    `initialise`, or setting a saved `state`, comes before everything else.
    """

    def __init__(self, parameters: MassesParameters, *, speed: SpeedLaw) -> None:
        self.parameters = parameters
        self._speed = speed
        self._offsets = np.array(parameters.offsets)
        # start time, time, time since the forces were last known; then, for every wheel,
        # displacement, velocity and force at that time, and the force's slope before it
        self._state: FloatArray = np.full(3 + 4 * len(self._offsets), math.nan)
        self._wheels = self._state[3:].reshape(4, -1)

    def initialise(self, time: float, forces: FloatArray, standing: Standing | None = None) -> None:
        """Put every wheel in its static position.

        Parameters
        ----------
        time : float
            Start time [s]; wheel 1 is at `initial_position` then.
        forces : ndarray, shape (wheels,)
            Contact forces [N]; in equilibrium they are the static load.
        standing : Standing, optional
            How the wheels stand and move; at rest on a level rail without.

        Raises
        ------
        ValueError
            If the time or a force is not finite.
        """
        if not math.isfinite(time):
            raise ValueError(f"the start time is {time:g} s; it must be a finite number")
        check_forces(forces)
        standing = standing or level(len(self._offsets))
        self._put(standing)
        self._state[:3] = time, time, 0.0
        self._wheels[1:] = standing.velocity, forces, np.zeros_like(forces)

    def step(self, time: float, step_size: float, forces: FloatArray, *, linear: bool) -> None:
        """Move on by one step.

        Parameters
        ----------
        time : float
            Start of the step [s], the end of the last one.
        step_size : float
            Its length [s].
        forces : ndarray, shape (wheels,)
            Contact forces [N], compression positive.
        linear : bool
            The forces are those at the end of the step; else those at its start.

        Raises
        ------
        ValueError
            If a force is not finite or drives a wheel out of the range of numbers, `time` is not
            where the model is, or `step_size` is not finite and above zero, or too small to move
            the time on.
        """
        require_step(time, step_size, reached=float(self._state[1]), what="masses are")
        check_forces(forces)
        before, passed = self.state, float(self._state[2])
        with np.errstate(over="ignore", invalid="ignore"):  # what is not finite is refused below
            if linear and passed > 0.0:  # where nobody tells what the forces have become
                self._follow(passed, self._wheels[2] + passed * self._wheels[3])
            self._follow(step_size if linear else passed, forces)
            self._state[1] = time + step_size
            self._state[2] = 0.0 if linear else step_size
            try:
                self._check_motion()
            except ValueError:
                self.state = before
                raise

    @property
    def state(self) -> FloatArray:
        """The complete state, shape (3 + 4 wheels,), as a copy; setting it restores every bit."""
        return self._state.copy()

    @state.setter
    def state(self, state: FloatArray) -> None:
        if state.shape != self._state.shape:
            raise ValueError(
                f"the state has shape {state.shape}; that of {len(self._offsets)} wheels has "
                f"{self._state.shape}"
            )
        self._state[:] = state

    @property
    def position(self) -> FloatArray:
        """Position of each wheel along the rail [m], shape (wheels,)."""
        way = self._speed.distance(float(self._state[0]), float(self._state[1]))
        return self.parameters.initial_position + way - self._offsets

    @property
    def displacement(self) -> FloatArray:
        """Displacement of each wheel from its static position [m], downwards, shape (wheels,)."""
        return self._moved(float(self._state[2]), self._wheels[3])[0]

    @property
    def velocity(self) -> FloatArray:
        """Velocity of each wheel [m/s], positive downwards, shape (wheels,)."""
        return self._moved(float(self._state[2]), self._wheels[3])[1]

    @property
    def load_change(self) -> FloatArray:
        """What each wheel starts with beyond its static load [N], shape (wheels,)."""
        return np.zeros_like(self._offsets)

    def _put(self, standing: Standing) -> None:
        """Place the wheels; a refusal leaves everything as it was."""
        del standing  # wheels that do not know of each other count from where they stand
        self._wheels[0] = 0.0

    def _check_motion(self) -> None:
        """Refuse a state in which not everything is a finite number."""
        require_position(float(self.position[0]), float(self._state[1]))
        force, slope = self._wheels[2:]
        z, v = self._moved(float(self._state[2]), slope)
        bad = np.flatnonzero(~(np.isfinite(z) & np.isfinite(v) & np.isfinite(slope)))
        if bad.size:
            i = int(bad[0])
            raise ValueError(
                f"the contact force of {force[i]:g} N on wheel {i + 1} drives the wheel to "
                f"{z[i]:g} m at {v[i]:g} m/s; give a smaller one or a step of another size"
            )

    def _follow(self, duration: float, forces: FloatArray) -> None:
        """Move to where the forces are known to have become the given ones."""
        if duration > 0.0:
            slope = (forces - self._wheels[2]) / duration
            self._wheels[:2] = self._moved(duration, slope)
            self._wheels[3] = slope
        self._wheels[2] = forces

    def _moved(self, duration: float, slope: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Displacement and velocity after a time in which the forces change at a given rate."""
        displacement, velocity, force, _ = self._wheels
        mass, load = self.parameters.wheel_mass, self.parameters.static_wheel_load
        return accelerated(
            displacement,
            velocity,
            duration=duration,
            acceleration=(load - force) / mass,
            jerk=-slope / mass,
        )


def accelerated(
    displacement: FloatArray,
    velocity: FloatArray,
    *,
    duration: float,
    acceleration: FloatArray,
    jerk: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """Return displacement [m] and velocity [m/s] after a time [s] of constant jerk [m/s3]."""
    moved = duration * (velocity + duration * (0.5 * acceleration + duration / 6.0 * jerk))
    return displacement + moved, velocity + duration * (acceleration + 0.5 * duration * jerk)


def check_forces(forces: FloatArray) -> None:
    """Raise ValueError unless every contact force [N] is a finite number, shape (wheels,)."""
    for number, force in enumerate(forces.tolist(), start=1):
        if not math.isfinite(force):
            raise ValueError(
                f"the contact force of wheel {number} is {force:g} N; it must be a finite number"
            )
