"""The track with the contacts on its side: wheel positions and displacements in, forces out."""

from __future__ import annotations

import math

import numpy as np

from .beam_element import FloatArray
from .contact_law import ContactLaw, Surface
from .contact_solution import solve_contact
from .contact_start import (
    INSTANT,
    SWAY,
    check_displacements,
    check_loads,
    check_start_inputs,
    first_step_doubts,
    surface_rate,
)
from .contact_state import ContactState
from .continuation import begin, continued, remember
from .observation import Observation
from .step_parts import count_parts
from .track_model import TrackModel

LONGEST_PART = 2e-4  # s; beyond it the contact forces on straight lines resolve no strike


class ContactTrack:
    """A track that finds the contact forces of its wheels itself, implicitly in every step.

    A compression is the displacement of a wheel less that of the rail and less the drops of tread
    and railhead. Displacements count from those at the start, where every wheel rests in static
    equilibrium, whatever they are there: a vehicle need not know how deep its wheels stand.

    Parameters
    ----------
    track : TrackModel
        The track, which is from then on driven from here alone.
    law : ContactLaw
        Contact force over compression.
    surface : Surface
        Drops of tread and railhead.
    static_load : float
        Contact force of every wheel at the start [N], at least 0.

    Raises
    ------
    ValueError
        If the load is not a number of at least 0.
    """

    def __init__(
        self, track: TrackModel, *, law: ContactLaw, surface: Surface, static_load: float
    ) -> None:
        if not (math.isfinite(static_load) and static_load >= 0.0):
            raise ValueError(
                f"track: static_wheel_load = {static_load!r} N must be a finite number, at least 0"
            )
        self._track, self._law, self._surface = track, law, surface
        self._static_load = static_load
        self._own = ContactState(wheels=track.options.wheels)

    @property
    def state(self) -> FloatArray:
        """Copy of the complete state; assigning one back restores the model bit for bit."""
        return np.concatenate((self._track.state, self._own.flat))

    @state.setter
    def state(self, saved: FloatArray) -> None:
        own = self._own.flat
        self._track.state = saved[: -own.size]
        own[:] = saved[-own.size :]

    @property
    def contact_force(self) -> FloatArray:
        """Contact forces [N], compression positive, shape (wheels,)."""
        return self._track.contact_force

    @property
    def contact_force_ahead(self) -> FloatArray:
        """Contact forces in the middle of a next step like the last one, expected [N], (wheels,).

        What a vehicle should be given that holds its inputs over a step.
        """
        return self._own.ahead.copy()

    @property
    def gap(self) -> FloatArray:
        """Gap between each wheel and the rail [m], minus the compression, shape (wheels,)."""
        return -self._own.compression

    @property
    def in_contact(self) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
        """Whether each wheel presses on the rail, shape (wheels,)."""
        return np.asarray(self._own.compression > 0.0)

    @property
    def rail_displacement(self) -> FloatArray:
        """Rail displacement under each wheel [m], shape (wheels,)."""
        return self._track.rail_displacement

    @property
    def static_displacement(self) -> FloatArray:
        """What a displacement of a wheel counts from: add it for that from the unloaded rail [m].

        Its displacement in the static equilibrium less the one that was given there, (wheels,).
        """
        return self._own.origin.copy()

    @property
    def static_velocity(self) -> FloatArray:
        """Velocity with which each wheel follows the surface at the start [m/s], (wheels,)."""
        return self._own.velocity.copy()

    @property
    def mean_velocity(self) -> FloatArray:
        """The same in the mean over `SWAY`, half of it before the start [m/s], (wheels,)."""
        return self._own.mean_velocity.copy()

    def observe(self) -> Observation:
        """Displacements, forces and bending moments of the track in the present state."""
        return self._track.observe()

    def start(
        self,
        positions: FloatArray,
        displacements: FloatArray,
        *,
        load_change: FloatArray | float = 0.0,
        velocity: FloatArray | float = 0.0,
    ) -> None:
        """Set the static equilibrium under the static loads.

        Parameters
        ----------
        positions, displacements : (wheels,) float array
            Of the wheels [m]; the displacements are what later ones count from.
        load_change : (wheels,) float array
            What each wheel presses with beyond the static load [N].
        velocity : (wheels,) float array
            With which the vehicle starts to move each wheel [m/s].

        Raises
        ------
        ValueError
            If a wheel is not on the track or not pressed on it, or a value is not a number.
        RuntimeError
            If the equilibrium is not found.
        """
        check_displacements(displacements)
        changes, velocities = (
            np.zeros_like(positions) + load_change,
            np.zeros_like(positions) + velocity,
        )
        check_start_inputs(changes, velocities)
        own, loads = self._own, self._static_load + changes
        check_loads(loads)
        self._track.start(positions, loads)
        own.compression[:] = self._law.compression(loads)
        own.origin[:] = self._track.rail_displacement + self._surface.drops(positions)
        own.origin += own.compression - displacements
        own.ahead[:] = loads
        speed = self._track.options.initial_speed
        own.velocity[:] = surface_rate(self._surface, positions, speed=speed, span=INSTANT)
        own.mean_velocity[:] = surface_rate(self._surface, positions, speed=speed, span=SWAY)
        own.passed[0] = 0.0
        self._begin(np.concatenate((positions, displacements)), velocities)

    def doubts(self, step_size: float, positions: FloatArray) -> list[str]:
        """What is doubtful about a first step of given start values, a sentence each."""
        return first_step_doubts(self._own, step_size, positions, longest=LONGEST_PART)

    def step(
        self,
        step_size: float,
        positions: FloatArray,
        displacements: FloatArray,
        *,
        linear: bool,
    ) -> None:
        """Advance by one step, in parts of `LONGEST_PART` at most.

        Parameters
        ----------
        step_size : float
            Any positive duration [s].
        positions, displacements : (wheels,) float array
            Of the wheels [m]: at the end of the step, reached on straight lines from the last
            ones (``linear``), or at its start, continued on the parabola through the last three.
        linear : bool
            Which of the two.

        Raises
        ------
        ValueError
            If the step is not positive or too long, see `count_parts`, a wheel leaves the track or
            an input is not a number.
        RuntimeError
            If the forces do not converge. The state is then unchanged.
        """
        parts = count_parts(step_size, LONGEST_PART)
        check_displacements(displacements)
        self._track.window.check(positions)
        own, before = self._own, self.state
        given = np.concatenate((positions, displacements))
        force = self.contact_force
        passed = float(own.passed[0])
        if passed > 0.0:
            # where nobody tells what the inputs have become, they are what was continued
            now = continued(own.history, own.ages, passed) if linear else given
            remember(own.history, own.ages, now, passed)
        elif not linear and not np.array_equal(given, own.history[0]):
            moved = own.history[0] - own.history[1]
            self._begin(given, moved[len(positions) :] / own.ages[0])
        try:
            for part in range(1, parts + 1):
                share = part / parts
                if linear:
                    wheels = own.history[0] + share * (given - own.history[0])
                else:
                    wheels = continued(own.history, own.ages, share * step_size)
                ahead, down = np.split(wheels, 2)
                if not self._track.window.endless:
                    # what is continued may lead a little beyond the track at its ends
                    ahead = np.clip(ahead, 0.0, self._track.track.parameters.length)
                self._advance(step_size / parts, ahead, down)
        except (ValueError, RuntimeError):
            self.state = before
            raise
        if linear:
            remember(own.history, own.ages, given, step_size)
        own.passed[0] = 0.0 if linear else step_size
        own.ahead[:] = np.maximum(1.5 * self.contact_force - 0.5 * force, 0.0)

    def _begin(self, given: FloatArray, velocity: FloatArray) -> None:
        """Continue given positions and displacements, these with a velocity, from nothing else."""
        speed = np.full_like(velocity, self._track.options.initial_speed)
        rate = np.concatenate((speed, velocity))
        begin(self._own.history, self._own.ages, given, rate=rate, age=LONGEST_PART)

    def _advance(self, step_size: float, positions: FloatArray, displacements: FloatArray) -> None:
        """Advance by one part, to given positions and displacements at its end."""
        own = self._own
        self._track.follow_wheels()
        operator = self._track.step_operator(step_size, positions, linear=True)
        solution = solve_contact(
            operator,
            self._law,
            level=displacements + own.origin - self._surface.drops(positions),
            compression=own.compression,
        )
        self._track.move(operator, solution.force, solution.increment)
        own.compression[:] = solution.compression
