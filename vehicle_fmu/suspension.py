"""The bodies above the contacts: how they hang together, their accelerations and forces."""

import numpy as np

from .suspension_parameters import (
    GRAVITY,
    BodyParameters,
    SuspensionElement,
    Tread,
    car_mass,
)
from .validation import FloatArray

SLACK = 1.0
"""What an element without stiffness counts with where a stiffness must be [N/m]."""


class Suspension:
    r"""Wheels, bogie frames and car body over one rail, coupled by springs and dampers.

    The coordinates, downwards positive and counted from static equilibrium, are

        q = [wheel (n), hub (n), bogie bounce (m), bogie pitch (m), car bounce, car pitch]

    with pitch positive where the front goes down. An element that is compressed by e = (E q)_k
    pushes with the force g_k(e, e') beyond its static one:

    .. math:: M \ddot q = p - E^T g(E q, E \dot q)

    where p holds what pushes each wheel down besides, static load minus contact force. Without a
    flexible wheelset the hubs rest, without bodies above the wheels these do.

    Parameters
    ----------
    offsets : tuple of float
        How far each wheel runs behind the first [m]; each bogie has the next of equal shares.
    wheel_mass : float
        Mass of a wheel, its tread included [kg].
    load : float
        Static load of a wheel, which all bodies together weigh [N].
    tread : Tread or None
        The outer part of a flexible wheelset; None for rigid wheels.
    bogies : int
        Number of bogies, m.
    bodies : BodyParameters or None
        Bogie frames and car body; None where the wheels bear nothing but their load.

    Attributes
    ----------
    levers, bogie_levers : ndarray, shape (wheels,) and (bogies,)
        How far each wheel is ahead of its bogie's centre, each bogie of the car body's [m].
    is_flexible, is_suspended : bool
        Whether there are hubs; whether there are bodies above the wheels.

    Raises
    ------
    ValueError
        If the wheels cannot be shared out among the bogies, the tread has the whole mass of a
        wheel, or the masses weigh more than the static loads.
    """

    def __init__(
        self,
        *,
        offsets: tuple[float, ...],
        wheel_mass: float,
        load: float,
        tread: Tread | None,
        bogies: int,
        bodies: BodyParameters | None,
    ) -> None:
        n, m = len(offsets), bogies
        if tread is not None and tread.mass >= wheel_mass:
            raise ValueError(
                f"tread.mass is {tread.mass:g} kg; it must be below wheel_mass, {wheel_mass:g} kg: "
                "the hub has the rest"
            )
        if n % m or (bodies is not None and len(bodies.bogie_mass) != m):
            raise ValueError(
                f"{n} wheels cannot be shared out among {m} bogies with masses of their own; give "
                "every bogie a mass and as many wheels"
            )
        self.wheels, self.bogies = n, m
        self.load = load
        self.is_flexible, self.is_suspended = tread is not None, bodies is not None
        centre = np.array(offsets).reshape(m, n // m).mean(axis=1)
        self.levers: FloatArray = np.repeat(centre, n // m) - np.array(offsets)
        self.bogie_levers: FloatArray = centre.mean() - centre
        self.inverse_mass = np.zeros(2 * n + 2 * m + 2)
        self.inverse_mass[:n] = 1.0 / (tread.mass if tread else wheel_mass)
        if tread is not None:
            self.inverse_mass[n : 2 * n] = 1.0 / (wheel_mass - tread.mass)
        self._elements: list[SuspensionElement] = []
        rows: list[FloatArray] = []
        if tread is not None:
            rows.append(np.eye(n, len(self.inverse_mass), n) - np.eye(n, len(self.inverse_mass)))
            element = SuspensionElement(stiffness=tread.stiffness, damping=tread.damping)
            self._elements += [element] * n
        self._static = np.zeros(n + m)
        if bodies is not None:
            car = car_mass(bodies, wheels=n, wheel_mass=wheel_mass, load=load)
            self._put_masses(bodies, car)
            rows.append(self._incidence(n if tread else 0))
            self._elements += [bodies.primary] * n + [bodies.secondary] * m
            on_wheel = load - wheel_mass * GRAVITY
            self._static[:n] = on_wheel
            self._static[n:] = n // m * on_wheel - np.array(bodies.bogie_mass) * GRAVITY
        self._elongation = np.vstack(rows) if rows else np.zeros((0, len(self.inverse_mass)))
        self._law = _Law(self._elements)

    @property
    def incidence(self) -> FloatArray:
        """Compression of every element over the coordinates, E, shape (elements, coordinates)."""
        return self._elongation.copy()

    def check_substep(self, substep: float) -> None:
        """Raise ValueError unless a substep [s] resolves every element between its bodies."""
        fastest = self._law.fastest((self._elongation**2) @ self.inverse_mass)
        if fastest * substep > 1.0:
            raise ValueError(
                f"a spring or damper of the suspension acts within {1.0 / fastest:g} s, the "
                f"substep is {substep:g} s; make it shorter, or springs and dampers softer"
            )

    def acceleration(self, q: FloatArray, v: FloatArray, push: FloatArray) -> FloatArray:
        """Return the accelerations [m/s2] and [rad/s2], shape (coordinates,).

        Parameters
        ----------
        q, v : ndarray, shape (coordinates,)
            Displacements [m], pitch [rad], and their rates.
        push : ndarray, shape (wheels,)
            Static load minus contact force of every wheel [N].
        """
        force = -(self._elongation.T @ self._deviations(q, v))
        force[: self.wheels] += push
        return force * self.inverse_mass

    def resistance(self, q: FloatArray) -> FloatArray:
        """Return what the elements push every coordinate back with at rest [N], [N m]."""
        force: FloatArray = self._elongation.T @ self._deviations(q, np.zeros_like(q))
        return force

    def stiffness(self, q: FloatArray) -> FloatArray:
        """Return how `resistance` rises with the coordinates, (coordinates, coordinates).

        An element that has no stiffness there counts with `SLACK`.
        """
        tangent = self._law.tangent(self._elongation @ q)
        matrix: FloatArray = self._elongation.T @ (tangent[:, None] * self._elongation)
        return matrix

    def forces(self, q: FloatArray, v: FloatArray) -> FloatArray:
        """Return the whole forces of primary and secondary suspension [N], compression positive.

        Shape (wheels + bogies,); zero where there are none.
        """
        if not self.is_suspended:
            return self._static
        return self._static + self._deviations(q, v)[-len(self._static) :]

    def energy(self, q: FloatArray, v: FloatArray) -> float:
        """Return kinetic and elastic energy beyond that of static equilibrium [J]."""
        moving = self.inverse_mass > 0.0
        kinetic = 0.5 * float((v[moving] ** 2 / self.inverse_mass[moving]).sum())
        return kinetic + self._law.energy(self._elongation @ q)

    def _deviations(self, q: FloatArray, v: FloatArray) -> FloatArray:
        """Forces of all elements beyond their static ones [N]."""
        return self._law.force(self._elongation @ q, self._elongation @ v)

    def _put_masses(self, bodies: BodyParameters, car: float) -> None:
        above = 2 * self.wheels
        masses = [*bodies.bogie_mass, *bodies.bogie_pitch_inertia, car, bodies.car_pitch_inertia]
        self.inverse_mass[above:] = 1.0 / np.array(masses)

    def _incidence(self, borne: int) -> FloatArray:
        """Rows of both suspensions; `borne` is the first coordinate of wheels or hubs below."""
        n, m = self.wheels, self.bogies
        above = 2 * n
        rows = np.zeros((n + m, len(self.inverse_mass)))
        for i, lever in enumerate(self.levers):
            j = i // (n // m)
            rows[i, borne + i] = -1.0
            rows[i, above + j] = 1.0
            rows[i, above + m + j] = lever
        for j, lever in enumerate(self.bogie_levers):
            rows[n + j, above + j] = -1.0
            rows[n + j, above + 2 * m] = 1.0
            rows[n + j, above + 2 * m + 1] = lever
        return rows


class _Law:
    """Force over compression and its rate, for all elements at once."""

    def __init__(self, elements: list[SuspensionElement]) -> None:
        self._stiffness = np.array([e.stiffness for e in elements])
        self._compressing = np.array([e.damping for e in elements])
        self._extending = np.array([e.damping * e.rebound_ratio for e in elements])
        self._stop = np.array([e.stop_stiffness for e in elements])
        self._clearance = np.array([e.clearance for e in elements])
        self._at_rest = np.maximum(-self._clearance, 0.0)

    def force(self, compression: FloatArray, rate: FloatArray) -> FloatArray:
        """Return the forces beyond the static ones [N]."""
        damping = np.where(rate < 0.0, self._extending, self._compressing)
        met = np.maximum(compression - self._clearance, 0.0) - self._at_rest
        force: FloatArray = self._stiffness * compression + self._stop * met + damping * rate
        return force

    def tangent(self, compression: FloatArray) -> FloatArray:
        """Return the stiffnesses there [N/m], `SLACK` instead of none."""
        met = np.where(compression > self._clearance, self._stop, 0.0)
        tangent: FloatArray = self._stiffness + met
        return np.where(tangent == 0.0, SLACK, tangent)

    def fastest(self, mobility: FloatArray) -> float:
        """Return the largest rate [1/s] of an element between bodies of these inverse masses."""
        vibration = np.sqrt((self._stiffness + self._stop) * mobility)
        decay = np.maximum(self._compressing, self._extending) * mobility
        return float(max(vibration.max(initial=0.0), decay.max(initial=0.0)))

    def energy(self, compression: FloatArray) -> float:
        """Return the work against springs and stops from static equilibrium [J]."""
        met = np.maximum(compression - self._clearance, 0.0)
        stops = 0.5 * (met**2 - self._at_rest**2) - self._at_rest * compression
        return float((0.5 * self._stiffness * compression**2 + self._stop * stops).sum())
