"""What can be observed on the track in a given state."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from .beam_element import FloatArray
from .bending import bending_moment
from .contact_point import RailPoint
from .eigensolver import ComplexArray
from .reduction import ReducedTrack
from .track_state import TrackState


class Observation:
    """Displacements, forces and bending moments of the track, each worked out when asked for.

    Parameters
    ----------
    track : ReducedTrack
        Modes and residual flexibility.
    state : TrackState
        Must not change while the observation is in use.
    wheels : sequence of RailPoint
        Where the wheels stand.
    gauges : sequence of RailPoint or None
        Where bending moments are wanted; None is beyond the window of an endless track.
    sleeper_mass : (supports,) float array, optional
        What the sleepers weigh beyond the nominal one [kg].
    """

    def __init__(
        self,
        track: ReducedTrack,
        state: TrackState,
        *,
        wheels: Sequence[RailPoint],
        gauges: Sequence[RailPoint | None],
        sleeper_mass: FloatArray | None = None,
    ) -> None:
        self._track, self._state, self._sleeper_mass = track, state, sleeper_mass
        self._wheels, self._gauges = wheels, gauges

    @cached_property
    def rail_velocity(self) -> FloatArray:
        """Rate of change of the rail displacement under each wheel, following it [m/s].

        ``u' = du/dt + v du/dx``, shape (wheels,).
        """
        velocity = np.empty(len(self._wheels))
        for i, (wheel, speed) in enumerate(zip(self._wheels, self._state.speed, strict=True)):
            shape, flexibility = self._track.shape[wheel.rows], self._track.flexibility[wheel.rows]
            displacement = np.real(shape @ self._modal) + flexibility @ self.forces
            rate = np.real(shape @ self._modal_rate) + flexibility @ self._force_rates
            velocity[i] = wheel.shape @ rate + speed * (wheel.slope @ displacement)
        return velocity

    @cached_property
    def rail_displacement(self) -> FloatArray:
        """Deflection [m] and rotation [rad] of the rail nodes, in the rows of `RailPoint.rows`.

        ``(2 * nodes,)``; a point is displaced by ``point.shape @ rail_displacement[point.rows]``.
        """
        return self._displacement(slice(self._track.ballast_rows.start))

    @cached_property
    def sleeper_displacement(self) -> FloatArray:
        """Displacement of every sleeper at its rail seat [m], shape (supports,)."""
        if self._track.parameters.sleeper == "rigid":
            return self.ballast_deformation
        return self._displacement(self._track.seat_rows) - self._displacement(self._track.pad_rows)

    @cached_property
    def ballast_deformation(self) -> FloatArray:
        """Deformation of the ballast under every sleeper [m], shape (supports,).

        Under a sleeper that bends, the weighted mean that drives state-dependent ballast.
        """
        return self._displacement(self._track.ballast_rows)

    @cached_property
    def sleeper_moment(self) -> FloatArray:
        """Bending moment of every sleeper at its rail seat [N m], sagging positive, (supports,).

        Zero for rigid sleepers, of which it is not known.
        """
        return self._moment_of_sleepers(0)

    @cached_property
    def sleeper_centre_moment(self) -> FloatArray:
        """Bending moment of every sleeper at its centre, as `sleeper_moment`."""
        return self._moment_of_sleepers(1)

    @cached_property
    def ballast_force(self) -> FloatArray:
        """Compression of the ballast under every sleeper [N], shape (supports,).

        The inertia of ballast that moves along is part of it, that of the sleeper is not.
        """
        parameters = self._track.parameters
        deformation, rate = self._mean_deformation
        return (
            parameters.ballast_stiffness * deformation
            + parameters.ballast_damping * rate
            + self._ballast_increment
        )

    @cached_property
    def pad_force(self) -> FloatArray:
        """Compression of every rail pad [N], shape (supports,)."""
        parameters = self._track.parameters
        return (
            parameters.pad_stiffness * self._displacement(self._track.pad_rows)
            + parameters.pad_damping * self._rate(self._track.pad_rows)
            + self._state.increment[parameters.supports :]
        )

    @cached_property
    def gauge_moment(self) -> FloatArray:
        """Bending moment at every gauge [N m], sagging positive, shape (gauges,).

        Zero beyond the window of an endless track, where the wheels are too far away to bend it.
        """
        return self._moments(self._gauges)

    @cached_property
    def wheel_moment(self) -> FloatArray:
        """Bending moment under every wheel [N m], sagging positive, shape (wheels,)."""
        return self._moments(self._wheels)

    @property
    def window_position(self) -> FloatArray:
        """Where the window of an endless track begins [m], shape (1,); 0 for an ordinary one."""
        return self._state.offset * self._track.parameters.sleeper_spacing

    @cached_property
    def _ballast_increment(self) -> FloatArray:
        """Increments of the ballast without the inertia of sleepers that differ, (supports,) [N].

        Where no increment is accounted for, neither is that inertia.
        """
        track = self._track
        increment = self._state.increment[: track.parameters.supports]
        if self._sleeper_mass is None:
            return increment
        twice = track.eigenvalues * self._modal_rate
        acceleration = np.real(track.shape[track.ballast_rows] @ twice)
        return np.where(increment == 0.0, 0.0, increment - self._sleeper_mass * acceleration)

    @cached_property
    def _modal(self) -> ComplexArray:
        return self._track.weight * self._state.modal

    @cached_property
    def _modal_rate(self) -> ComplexArray:
        state, track = self._state, self._track
        return track.weight * (track.eigenvalues * state.modal + state.load)

    @cached_property
    def forces(self) -> FloatArray:
        """Forces on the coordinates, those of wheels and increments [N], [N m], shape (n,)."""
        forces = np.zeros(len(self._track.flexibility))
        forces[self._track.ballast_rows.start :] = -self._state.increment
        for wheel, force in zip(self._wheels, self._state.force, strict=True):
            forces[wheel.rows] += force * wheel.shape
        return forces

    @cached_property
    def _force_rates(self) -> FloatArray:
        """Rate of change of the forces on the coordinates, the wheels' motion included."""
        state = self._state
        rates = np.zeros(len(self._track.flexibility))
        rates[self._track.ballast_rows.start :] = -state.increment_rate
        for i, wheel in enumerate(self._wheels):
            rates[wheel.rows] += state.force_rate[i] * wheel.shape
            rates[wheel.rows] += state.force[i] * state.speed[i] * wheel.slope
        return rates

    @cached_property
    def _mean_deformation(self) -> tuple[FloatArray, FloatArray]:
        """Mean deformation of the linear ballast and its rate, shape (supports,) each."""
        track = self._track
        if track.parameters.sleeper == "rigid":
            return self.ballast_deformation, self._rate(track.ballast_rows)
        rows = slice(2 * track.parameters.supports, None)
        shape, flexibility = track.sleeper_shape[rows], track.sleeper_flexibility[rows]
        return (
            np.real(shape @ self._modal) + flexibility @ self.forces,
            np.real(shape @ self._modal_rate) + flexibility @ self._force_rates,
        )

    def _moment_of_sleepers(self, place: int) -> FloatArray:
        supports = self._track.parameters.supports
        if self._track.parameters.sleeper == "rigid":
            return np.zeros(supports)
        rows = slice(place * supports, (place + 1) * supports)
        modal = np.real(self._track.sleeper_shape[rows] @ self._modal)
        return modal + self._track.sleeper_flexibility[rows] @ self.forces

    def _displacement(self, rows: slice) -> FloatArray:
        modal = np.real(self._track.shape[rows] @ self._modal)
        return modal + self._track.flexibility[rows] @ self.forces

    def _rate(self, rows: slice) -> FloatArray:
        modal = np.real(self._track.shape[rows] @ self._modal_rate)
        return modal + self._track.flexibility[rows] @ self._force_rates

    def _moments(self, points: Sequence[RailPoint | None]) -> FloatArray:
        loads = list(zip(self._wheels, self._state.force.tolist(), strict=True))
        return np.array(
            [
                0.0
                if point is None
                else bending_moment(
                    self._track,
                    point,
                    modal_state=self._modal,
                    forces=self.forces,
                    loads=loads,
                )
                for point in points
            ]
        )
