"""What the coupled system asks of a vehicle, and rigid wheels that are nothing but masses.

A vehicle has c coordinates, counted from static equilibrium on a level rail at the mean height that
the wheels have at the start, downwards positive. The first w are those of what touches the rail.
Each is pushed down by its static load less the contact force; all other static forces cancel.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

FREQUENCY = 1e4
"""Velocities on the rail may be wrong by this times what displacements may be [rad/s]."""


class Vehicle(Protocol):
    """A vehicle over one rail.

    Attributes
    ----------
    wheels : int
        Number of wheels w.
    contact_mass : float
        What moves with each contact [kg].
    scale, rate_scale : ndarray, shape (c,)
        How large coordinates and their rates are where displacements of wheels are one metre.
    mobility : ndarray, shape (c, wheels)
        Accelerations under a unit push on each wheel [1/kg].
    """

    wheels: int
    contact_mass: float
    scale: Array
    rate_scale: Array
    mobility: Array

    def accelerations(self, place: Array, rate: Array, push: Array) -> Array:
        """Return the second derivatives of the coordinates, shape (c,).

        Parameters
        ----------
        place, rate : ndarray, shape (c,)
            Coordinates and their rates.
        push : ndarray, shape (wheels,)
            Static load less contact force of every wheel [N].
        """
        ...

    def tangent(self, place: Array, rate: Array) -> tuple[Array, Array]:
        """Return their derivatives by coordinates and by rates, shape (c, c) each."""
        ...

    def riding(self, wheels: Array) -> Array:
        """Return coordinates of bodies that ride on displaced wheels, shape (c,).

        Each lies on the straight line of least squares through what bears it; with two wheels a
        bogie and two bogies no spring is compressed then. Rates follow from rates likewise.

        Parameters
        ----------
        wheels : ndarray, shape (wheels,)
            Displacements of the wheels [m].
        """
        ...

    def ways_to_stops(self, place: Array) -> Array:
        """Return what changes sign where a bump stop is met or left [m], shape (stops,)."""
        ...

    def observe(self, places: Array, rates: Array, accelerations: Array) -> Mapping[str, Array]:
        """Return what a result holds of the bodies above the wheels, shape (bodies, times) each.

        Parameters
        ----------
        places, rates, accelerations : ndarray, shape (c, times)
            Coordinates and their derivatives.
        """
        ...


class RigidWheels:
    """Masses under their loads, one a wheel; see `Vehicle`.

    Parameters
    ----------
    wheels : int
        Number of wheels.
    mass : float
        Of each [kg].
    """

    def __init__(self, wheels: int, mass: float) -> None:
        self.wheels, self.contact_mass = wheels, mass
        self.scale, self.rate_scale = np.ones(wheels), np.full(wheels, FREQUENCY)
        self.mobility = np.eye(wheels) / mass
        self._nothing = np.zeros((wheels, wheels))

    def accelerations(self, place: Array, rate: Array, push: Array) -> Array:
        """See `Vehicle.accelerations`."""
        del place, rate
        return np.asarray(push / self.contact_mass)

    def tangent(self, place: Array, rate: Array) -> tuple[Array, Array]:
        """See `Vehicle.tangent`."""
        del place, rate
        return self._nothing, self._nothing

    def riding(self, wheels: Array) -> Array:
        """Return the wheels: there are no bodies above."""
        return wheels.copy()

    def ways_to_stops(self, place: Array) -> Array:
        """Return nothing: there are no stops."""
        return place[:0]

    def observe(self, places: Array, rates: Array, accelerations: Array) -> Mapping[str, Array]:
        """Return nothing: there are no bodies above."""
        del places, rates, accelerations
        return {}
