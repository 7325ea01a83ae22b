"""The track as a dynamic model: contact forces at moving positions in, displacements out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .beam_element import FloatArray
from .component_law import ComponentLaw
from .components import ActiveComponents, Components
from .exponential_step import ExponentialSteps
from .observation import Observation
from .reduction import ReducedTrack
from .static_start import static_start
from .step_operator import StepOperator
from .step_parts import count_parts
from .supports import nearest_supports
from .track_state import TrackState
from .window import Window

LONGEST_STEP = 5e-4  # s; beyond about 1.5 ms force increments on straight lines are unstable


@dataclass(frozen=True, slots=True, kw_only=True)
class TrackOptions:
    """How the track is loaded and observed.

    Parameters
    ----------
    wheels : int
        Number of wheels, at least 1.
    supports_per_wheel : int
        Supports around each wheel whose pads and ballast are state-dependent.
    initial_speed : float
        Speed with which the static deflection moves along at the start [m/s].
    gauges : tuple of float
        Track positions at which the bending moment is observed [m].
    endless : bool
        Whether the track goes on without end, the model holding the part around the wheels.
    """

    wheels: int = 2
    supports_per_wheel: int = 6
    initial_speed: float = 0.0
    gauges: tuple[float, ...] = ()
    endless: bool = False

    def __post_init__(self) -> None:
        for name in ("wheels", "supports_per_wheel"):
            if getattr(self, name) < 1:
                raise ValueError(f"track: {name} = {getattr(self, name)!r} must be at least 1")
        if not np.isfinite(self.initial_speed):
            raise ValueError(f"track: initial_speed = {self.initial_speed!r} m/s must be finite")


class TrackModel:
    """Complex modal track with state-dependent pads and ballast under moving contact forces.

    Downwards positive; contact forces press the rail down. `start` puts the track in nonlinear
    static equilibrium, `step` moves it on, `observe` shows it; everything it knows between two
    steps is in `state`.

    Parameters
    ----------
    track : ReducedTrack
        Modes and residual flexibility.
    options : TrackOptions
        Wheels, supports, gauges.
    ballast, pad : ComponentLaw or None
        State-dependent force laws; None is linear.
    """

    def __init__(
        self,
        track: ReducedTrack,
        options: TrackOptions,
        *,
        ballast: ComponentLaw | None = None,
        pad: ComponentLaw | None = None,
    ) -> None:
        self.track = track
        self.options = options
        self._components = Components(track, ballast=ballast, pad=pad)
        self._state = TrackState(
            wheels=options.wheels,
            components=self._components.count,
            modes=len(track.eigenvalues),
        )
        self.window = Window(track, self._state, endless=options.endless)
        for position in options.gauges:
            self.window.find(position)  # refuses one beyond an ordinary track
        self._exponentials = ExponentialSteps(track.eigenvalues)
        self._operator: StepOperator | None = None
        self._observation: Observation | None = None

    @property
    def state(self) -> FloatArray:
        """Copy of the complete state; assigning one back restores the model bit for bit."""
        return self._state.flat.copy()

    @state.setter
    def state(self, saved: FloatArray) -> None:
        if saved.shape != self._state.flat.shape:
            raise ValueError(
                f"track: a state of {saved.size} numbers does not fit this track, whose state "
                f"has {self._state.flat.size}; it was saved with other parameters"
            )
        self._state.flat[:] = saved
        self._observation = None

    @property
    def rail_displacement(self) -> FloatArray:
        """Rail displacement under each wheel [m], shape (wheels,)."""
        return self._state.displacement.copy()

    @property
    def contact_force(self) -> FloatArray:
        """Contact forces as last applied [N], shape (wheels,)."""
        return self._state.force.copy()

    def start(self, positions: FloatArray, forces: FloatArray) -> None:
        """Set the static equilibrium under the given wheels, moving at the initial speed.

        Parameters
        ----------
        positions, forces : (wheels,) float array
            Track positions [m] and contact forces [N].

        Raises
        ------
        ValueError
            If a wheel is not on the track or a force is not a number.
        RuntimeError
            If the equilibrium is not found.
        """
        self._check_forces(forces)
        self.window.check(positions)
        self.window.centre(positions)
        wheels = self.window.locate(positions)
        static_start(
            self._state,
            self.track,
            self._active(positions),
            wheels=wheels,
            forces=forces,
            speed=self.options.initial_speed,
        )
        self._state.position[:] = positions
        self._observation = None

    def step(
        self, step_size: float, positions: FloatArray, forces: FloatArray, *, linear: bool = True
    ) -> None:
        """Advance by one step; a long one is divided into parts of `LONGEST_STEP` at most.

        Parameters
        ----------
        step_size : float
            Any positive duration [s].
        positions, forces : (wheels,) float array
            Track positions [m] and contact forces [N]: at the end of the step, reached on a
            straight line from the last ones (``linear``), or held over the step.
        linear : bool
            Which of the two.

        Raises
        ------
        ValueError
            If the step is not positive or too long, see `count_parts`, a wheel leaves the track or
            a force is not a number.
        RuntimeError
            If the state-dependent forces do not converge: the step is too long. The state is
            then unchanged.
        """
        parts = count_parts(step_size, LONGEST_STEP)
        self._check_forces(forces)
        self.window.check(positions)
        before = self._state.flat.copy() if parts > 1 or self.window.endless else None
        start, start_force = self._state.position.copy(), self._state.force.copy()
        try:
            for part in range(1, parts + 1):
                share = part / parts if linear and part < parts else 1.0
                self.follow_wheels()
                operator = self.step_operator(
                    step_size / parts,
                    positions if share == 1.0 else start + share * (positions - start),
                    linear=linear,
                )
                operator.apply(
                    self._state,
                    forces if share == 1.0 else start_force + share * (forces - start_force),
                )
        except (ValueError, RuntimeError):
            if before is not None:
                self.state = before
            raise
        self._observation = None

    def observe(self) -> Observation:
        """Displacements, forces and bending moments in the present state, until it changes."""
        if self._observation is None:
            self._observation = Observation(
                self.track,
                self._state,
                wheels=self.window.locate(self._state.position),
                gauges=[self.window.find(position) for position in self.options.gauges],
            )
        return self._observation

    def follow_wheels(self) -> None:
        """Move the window of an endless track where that is due, before an undivided step."""
        if self.window.follow(lambda: self.observe().forces):
            self._observation = None

    def step_operator(
        self, step_size: float, positions: FloatArray, *, linear: bool
    ) -> StepOperator:
        """One undivided step to given wheel positions, for any forces; kept to be repeated."""
        operator = self._operator
        if operator is None or not operator.serves(self._state, step_size, positions, linear):
            operator = self._operator = StepOperator(
                self._state,
                self.track,
                self._active(positions),
                self._exponentials.of(step_size),
                step_size=step_size,
                positions=positions,
                wheels=self.window.locate(positions),
                linear=linear,
            )
        return operator

    def move(self, operator: StepOperator, forces: FloatArray, increment: FloatArray) -> None:
        """Take the step of an operator under given forces and active increments at its end."""
        operator.move(self._state, forces, increment)
        self._observation = None

    def _check_forces(self, forces: FloatArray) -> None:
        for number, force in enumerate(forces, start=1):
            if not np.isfinite(force):
                raise ValueError(
                    f"track: contact force {float(force)!r} N of wheel {number} must be a finite "
                    "number; look for the cause in the vehicle"
                )

    def _active(self, positions: FloatArray) -> ActiveComponents:
        parameters, count = self.track.parameters, self.options.supports_per_wheel
        nearest = nearest_supports(parameters, positions - self.window.position, count)
        return self._components.active(nearest, self.window.bays_before)
