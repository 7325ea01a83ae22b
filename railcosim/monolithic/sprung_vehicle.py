"""A vehicle with springs, body by body: flexible wheelsets, bogie frames and a car body.

A body that goes down by ``y`` and turns by ``phi``, nose down positive, lies ``y + a phi`` lower at
a distance ``a`` before its middle. A spring that is compressed more than in static equilibrium
pushes what is below it down and what is above it up.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from .springs import Spring, Springs
from .vehicle import FREQUENCY

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

BODY_FREQUENCY = 1e2
"""Rates of bodies on soft springs may be wrong by this times what displacements may be [rad/s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Wheelset:
    """A wheel over one rail, which may be flexible.

    Attributes
    ----------
    tread, hub : float
        Masses of what touches the rail and of the rest, 0 for a rigid wheel [kg].
    spring : Spring, optional
        Between both.
    """

    tread: float
    hub: float = 0.0
    spring: Spring | None = None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Superstructure:
    """What is above w wheels in m bogies, over one rail.

    Attributes
    ----------
    bogie_mass, bogie_inertia, car_mass, car_inertia : float
        Of each bogie frame and of the car body [kg], [kg m2].
    levers : ndarray, shape (m, w / m)
        How far each wheel is before the middle of its bogie [m].
    car_levers : ndarray, shape (m,)
        How far the middle of each bogie is before that of the car body [m].
    primary, secondary : Spring
        Between each wheel and its frame; between each frame's middle and the car body.
    primary_load, secondary_load : float
        What each of them carries in static equilibrium [N].
    """

    bogie_mass: float
    bogie_inertia: float
    car_mass: float
    car_inertia: float
    levers: Array
    car_levers: Array
    primary: Spring
    secondary: Spring
    primary_load: float
    secondary_load: float


class Motion(NamedTuple):
    """The coordinates, or what belongs to them, body by body; what there is not is empty.

    Attributes
    ----------
    treads, hubs : ndarray, shape (w, ...)
        Of every wheel.
    frames, pitches : ndarray, shape (m, ...)
        Bounce and pitch of every bogie frame.
    car, car_pitch : ndarray, shape (1, ...)
        Those of the car body.
    """

    treads: Array
    hubs: Array
    frames: Array
    pitches: Array
    car: Array
    car_pitch: Array


class SprungVehicle:
    """Bodies coupled by springs; see `Vehicle`, and `Motion` for the order of the coordinates.

    Parameters
    ----------
    wheels : int
        Number of wheels.
    wheelset : Wheelset
        Every one of them.
    above : Superstructure or None
        None where the wheels bear nothing but their load.
    """

    def __init__(self, wheels: int, wheelset: Wheelset, above: Superstructure | None) -> None:
        self.wheels, self.contact_mass = wheels, wheelset.tread
        self._wheelset, self._above = wheelset, above
        springs: list[Spring] = []
        if wheelset.spring is not None:
            springs += [wheelset.spring] * wheels
        bogies = 0
        if above is not None:
            bogies = len(above.car_levers)
            springs += [above.primary] * wheels + [above.secondary] * bogies
        self._springs = Springs(springs)
        hubs = 0 if wheelset.spring is None else wheels
        self._ends = np.cumsum((wheels, hubs, bogies, bogies, min(bogies, 1)))
        size = int(self._ends[-1]) + min(bogies, 1)
        self._compressions = np.stack([self._compress(self._motion(q)) for q in np.eye(size)]).T
        self._answers = np.stack([self._push(force) for force in np.eye(len(springs))]).T
        self.mobility = np.eye(size, wheels) / wheelset.tread
        self.scale, self.rate_scale = self._scales(size)

    def accelerations(self, place: Array, rate: Array, push: Array) -> Array:
        """See `Vehicle.accelerations`."""
        forces = self._springs.force(self._compressions @ place, self._compressions @ rate)
        return np.asarray(self._answers @ forces + self.mobility @ push)

    def tangent(self, place: Array, rate: Array) -> tuple[Array, Array]:
        """See `Vehicle.tangent`."""
        stiffness, damping = self._springs.tangent(
            self._compressions @ place, self._compressions @ rate
        )
        return (
            self._answers @ (stiffness[:, None] * self._compressions),
            self._answers @ (damping[:, None] * self._compressions),
        )

    def riding(self, wheels: Array) -> Array:
        """See `Vehicle.riding`."""
        hubs = wheels if self._wheelset.spring is not None else wheels[:0]
        if self._above is None:
            return np.concatenate((wheels, hubs))
        levers = self._above.levers
        lines = [_line(*each) for each in zip(levers, wheels.reshape(levers.shape), strict=True)]
        frames, pitches = np.array(lines).T
        return np.concatenate(
            (wheels, hubs, frames, pitches, _line(self._above.car_levers, frames))
        )

    def ways_to_stops(self, place: Array) -> Array:
        """See `Vehicle.ways_to_stops`."""
        return self._springs.ways_to_stops(self._compressions @ place)

    def observe(self, places: Array, rates: Array, accelerations: Array) -> Mapping[str, Array]:
        """See `Vehicle.observe`: displacements, and whole forces in compression positive."""
        if self._above is None:
            return {}
        forces = self._springs.force(
            (self._compressions @ places).T, (self._compressions @ rates).T
        ).T
        _, primary, secondary = self._by_kind(forces)
        motion, acceleration = self._motion(places), self._motion(accelerations)
        return {
            "bogie_displacement": motion.frames,
            "bogie_pitch": motion.pitches,
            "bogie_acceleration": acceleration.frames,
            "car_displacement": motion.car,
            "car_pitch": motion.car_pitch,
            "car_acceleration": acceleration.car,
            "primary_force": self._above.primary_load + primary,
            "secondary_force": self._above.secondary_load + secondary,
        }

    def _motion(self, values: Array) -> Motion:
        return Motion(*np.split(values, self._ends))

    def _by_kind(self, forces: Array) -> tuple[Array, Array, Array]:
        """Forces within the wheelsets, of primary and of secondary suspension."""
        within = 0 if self._wheelset.spring is None else self.wheels
        primary = 0 if self._above is None else self.wheels
        first, second, third = np.split(forces, [within, within + primary])
        return first, second, third

    def _compress(self, body: Motion) -> Array:
        """Compressions of all springs [m]."""
        within = body.hubs - body.treads if body.hubs.size else body.hubs
        if self._above is None:
            return within
        bearing = body.hubs if body.hubs.size else body.treads
        ends = body.frames[:, None] + self._above.levers * body.pitches[:, None]
        pivots = body.car + self._above.car_levers * body.car_pitch
        return np.concatenate((within, ends.ravel() - bearing, pivots - body.frames))

    def _push(self, forces: Array) -> Array:
        """Accelerations of all bodies under the forces of all springs."""
        within, primary, secondary = self._by_kind(forces)
        wheelset, above = self._wheelset, self._above
        on_wheels = primary if above is not None else np.zeros(self.wheels)
        accelerations = [on_wheels / wheelset.tread]
        if wheelset.spring is not None:
            accelerations = [within / wheelset.tread, (on_wheels - within) / wheelset.hub]
        if above is not None:
            of_bogies = primary.reshape(above.levers.shape)
            accelerations += [
                (secondary - of_bogies.sum(axis=1)) / above.bogie_mass,
                -(above.levers * of_bogies).sum(axis=1) / above.bogie_inertia,
                np.array([-secondary.sum() / above.car_mass]),
                np.array([-(above.car_levers * secondary).sum() / above.car_inertia]),
            ]
        return np.concatenate(accelerations)

    def _scales(self, size: int) -> tuple[Array, Array]:
        """Scales of coordinates and rates; the ends of a body that pitches count."""
        scale, rate = np.ones(size), np.full(size, BODY_FREQUENCY)
        rate[: int(self._ends[1])] = FREQUENCY
        if self._above is not None:
            pitches = slice(*self._ends[2:4])
            scale[pitches] /= np.abs(self._above.levers).max(initial=1.0)
            scale[-1] /= np.abs(self._above.car_levers).max(initial=1.0)
        return scale, rate * scale


def _line(levers: Array, heights: Array) -> tuple[float, float]:
    """Mean and slope of the line of least squares, over levers with a mean of zero."""
    return float(heights.mean()), float(np.linalg.pinv(levers[:, None])[0] @ heights)
