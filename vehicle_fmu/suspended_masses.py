"""The suspended vehicle under given contact forces, which come from elsewhere."""

import math

import numpy as np

from .equilibrium import TOLERANCE, follow, settle
from .integration import require_substeps, substeps_of
from .masses import Masses, MassesParameters, check_forces
from .speed import SpeedLaw
from .standing import Standing
from .suspended_motion import advance
from .suspension import Suspension
from .validation import FloatArray, require_position, require_positive, require_step

SUBSTEP = 2e-5
"""Longest internal integration step, where nothing is said [s]."""


class SuspendedMasses(Masses):
    """`Masses` whose wheels are coupled by the bodies above them.

    The contact forces run on straight lines as they do there; on these the motion is integrated
    with substeps.

    Parameters
    ----------
    parameters, speed
        As for `Masses`.
    suspension : Suspension
        Of as many wheels, with the same masses and loads.
    substep : float
        Longest internal integration step [s].

    Raises
    ------
    ValueError
        If the substep is not above zero, or too long for the suspension.
    """

    def __init__(
        self,
        parameters: MassesParameters,
        *,
        speed: SpeedLaw,
        suspension: Suspension,
        substep: float = SUBSTEP,
    ) -> None:
        super().__init__(parameters, speed=speed)
        require_positive("substep", substep, "s", "2e-5 resolves a flexible wheelset")
        suspension.check_substep(substep)
        self.suspension = suspension
        self._substep = substep
        n, count = suspension.wheels, len(suspension.inverse_mass)
        # that of the masses, in which displacement and velocity are those of the wheels; then the
        # other coordinates and their rates, at that time as well; then all of them at the present;
        # what displacements of the wheels count from, and their changes of load
        self._state = np.full(3 + 6 * n + 2 * (count - n) + 2 * count, math.nan)
        ends = np.cumsum([3 + 4 * n, 2 * (count - n), 2 * count])
        self._wheels = self._state[3 : ends[0]].reshape(4, n)
        self._above = self._state[ends[0] : ends[1]].reshape(2, count - n)
        self._ahead = self._state[ends[1] : ends[2]].reshape(2, count)
        self._origin, self._load_change = self._state[ends[2] :].reshape(2, n)

    def initialise(self, time: float, forces: FloatArray, standing: Standing | None = None) -> None:
        """Put the vehicle in static equilibrium; see `Masses.initialise`."""
        super().initialise(time, forces, standing)
        self._ahead[:] = np.concatenate([self._wheels[:2], self._above], axis=1)

    def step(self, time: float, step_size: float, forces: FloatArray, *, linear: bool) -> None:
        """Move on by one step; see `Masses.step`."""
        require_step(time, step_size, reached=float(self._state[1]), what="masses are")
        check_forces(forces)
        require_substeps(step_size, self._substep)
        before, passed = self.state, float(self._state[2])
        with np.errstate(over="ignore", invalid="ignore"):  # what is not finite is refused below
            if linear and passed > 0.0:  # where nobody tells what the forces have become
                self._put_known(self._ahead, self._wheels[2] + passed * self._wheels[3])
            self._follow(step_size if linear else passed, forces)
            self._state[1] = time + step_size
            self._state[2] = 0.0 if linear else step_size
            self._ahead[:] = self._advanced(float(self._state[2]), self._wheels[3])
            try:
                self._check_bodies()
            except ValueError:
                self.state = before
                raise

    @property
    def coordinates(self) -> tuple[FloatArray, FloatArray]:
        """Coordinates of the suspension, from static equilibrium, and their rates."""
        return self._ahead[0].copy(), self._ahead[1].copy()

    @property
    def push(self) -> FloatArray:
        """Static load minus contact force of every wheel [N], shape (wheels,)."""
        return self._pushed(float(self._state[2]), self._wheels[3])

    @property
    def displacement(self) -> FloatArray:
        """Displacement of each wheel from its static position [m], downwards, shape (wheels,)."""
        place: FloatArray = self._ahead[0, : self.suspension.wheels] - self._origin
        return place

    @property
    def load_change(self) -> FloatArray:
        """What each wheel starts with beyond its static load [N], shape (wheels,)."""
        return self._load_change.copy()

    @property
    def velocity(self) -> FloatArray:
        """Velocity of each wheel [m/s], positive downwards, shape (wheels,)."""
        return self._ahead[1, : self.suspension.wheels].copy()

    def _put(self, standing: Standing) -> None:
        own, n = self.suspension, self.suspension.wheels
        height = standing.displacement - standing.displacement.mean()
        with np.errstate(over="ignore", invalid="ignore"):  # what is not finite is refused there
            q = settle(own, follow(own, height))
            pressed = -own.resistance(q)[:n]
        self._above[:] = q[n:], follow(own, standing.mean_velocity)[n:]
        self._wheels[0] = self._origin[:] = height
        # rounding would not let loads be what they are at any height
        given = np.abs(pressed) <= TOLERANCE * own.load
        self._load_change[:] = np.where(given, 0.0, pressed)

    def _follow(self, duration: float, forces: FloatArray) -> None:
        if duration > 0.0:
            slope = (forces - self._wheels[2]) / duration
            self._put_known(self._advanced(duration, slope), forces)
            self._wheels[3] = slope
        self._wheels[2] = forces

    def _put_known(self, motion: FloatArray, forces: FloatArray) -> None:
        """Take over the coordinates and rates at which the forces are known to be these."""
        n = self.suspension.wheels
        self._wheels[:2] = motion[:, :n]
        self._above[:] = motion[:, n:]
        self._wheels[2] = forces

    def _advanced(self, duration: float, slope: FloatArray) -> FloatArray:
        """Coordinates and rates after a time in which the forces change at a given rate."""
        known = np.concatenate([self._wheels[:2], self._above], axis=1)
        if duration == 0.0:
            return known
        substeps = substeps_of(duration, self._substep)

        def push(k: int, _: FloatArray) -> FloatArray:
            return self._pushed(0.5 * k * duration / substeps, slope)

        return np.array(
            advance(
                self.suspension,
                known[0],
                known[1],
                duration=duration,
                substeps=substeps,
                push=push,
            )
        )

    def _pushed(self, duration: float, slope: FloatArray) -> FloatArray:
        push: FloatArray = self.parameters.static_wheel_load - (self._wheels[2] + duration * slope)
        return push

    def _check_bodies(self) -> None:
        """Refuse a state in which not everything is a finite number."""
        require_position(float(self.position[0]), float(self._state[1]))
        known = np.concatenate([self._wheels.ravel(), self._above.ravel(), self._ahead.ravel()])
        if not np.isfinite(known).all():
            worst = int(np.argmax(np.abs(self.push)))
            raise ValueError(
                f"the contact forces, {self._wheels[2, worst]:g} N on wheel {worst + 1}, drive the "
                "vehicle out of the range of numbers; give smaller ones or a step of another size"
            )
