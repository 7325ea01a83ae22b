"""Ballast that moves along with the sleepers, and sleepers that differ in mass."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from .assembly import IntArray
from .beam_element import FloatArray
from .component_law import MemorylessLaw, Tangents
from .total_ballast import TINY, Contact, TotalBallast, secant


class _Mass(NamedTuple):
    """Mass that moves along [kg], its derivatives by the deformation [kg/m], [kg/m2]."""

    mass: FloatArray
    slope: FloatArray
    bend: FloatArray


@dataclass(frozen=True, slots=True, kw_only=True)
class HeavyBallast(MemorylessLaw):
    """A ballast law with the acceleration term that may be added to Eq. (24).

    Ballast of the mass ``m(x)`` under a rail seat that moves along has the kinetic energy
    ``m x'^2 / 2`` and adds ``m x'' + m_x x'^2 / 2``. It is constant, or grows as the secant
    stiffness does, ``m(x) = m_0 e(x) / (k x)``, like the damping of Eq. (29). Where a sleeper can
    lift off, the mass moves along while the ballast is pressed and sets in as the damping does; the
    total force is not below the least one of `TotalBallast` then, its inertia included.

    A sleeper heavier than the nominal one by ``M`` adds ``M x''`` always.

    Parameters
    ----------
    bed : TotalBallast
        The ballast without mass.
    mass : float
        Of the ballast under an unloaded rail seat, ``m_0`` [kg].
    grows : bool
        Whether it grows with the secant stiffness.
    nominal_sleeper : float
        Mass of a sleeper that the supports' factors apply to [kg].

    Raises
    ------
    ValueError
        If the mass is not a number of at least 0.
    """

    bed: TotalBallast
    mass: float
    grows: bool
    nominal_sleeper: float

    def __post_init__(self) -> None:
        if not (math.isfinite(self.mass) and self.mass >= 0.0):
            raise ValueError(
                f"ballast: mass = {self.mass!r} kg must be a finite number, at least 0"
            )

    @property
    def stiff(self) -> bool:
        """Yes; see `ComponentLaw.stiff`."""
        return True

    @property
    def sleeper_mass(self) -> FloatArray:
        """What the sleepers weigh beyond the nominal one; see `InertialLaw.sleeper_mass`."""
        return (self.bed.factors.sleeper_mass - 1.0) * self.nominal_sleeper

    def moved(self, first: int, count: int) -> HeavyBallast:
        """Return the law of other supports; see `ComponentLaw.moved`."""
        return replace(self, bed=self.bed.moved(first, count))

    def force(self, deformation: FloatArray, rate: FloatArray, support: IntArray) -> FloatArray:
        """Force increment of slow motion [N]; see `ComponentLaw.force`."""
        return self.bed.force(deformation, rate, support)

    def stiffness(self, deformation: FloatArray, rate: FloatArray, support: IntArray) -> FloatArray:
        """Its derivative by the deformation [N/m]; see `ComponentLaw.stiffness`."""
        return self.bed.stiffness(deformation, rate, support)

    def damping(self, deformation: FloatArray, rate: FloatArray, support: IntArray) -> FloatArray:
        """Its derivative by the rate [N s/m]; see `ComponentLaw.damping`."""
        return self.bed.damping(deformation, rate, support)

    def moving_force(
        self, deformation: FloatArray, rate: FloatArray, acceleration: FloatArray, support: IntArray
    ) -> FloatArray:
        """Force increment [N]; see `InertialLaw.moving_force`."""
        bed, parts = self.bed, self.bed.parts(deformation, support)
        moved = self._moved(deformation, support, parts.contact)
        total = parts.load + parts.damping * rate
        total = total + moved.mass * acceleration + 0.5 * moved.slope * rate * rate
        total = np.maximum(total, parts.contact.least)
        linear = bed.linear_stiffness * deformation + bed.linear_damping * rate
        return np.asarray(total - linear + self.sleeper_mass[support] * acceleration)

    def moving_tangents(
        self, deformation: FloatArray, rate: FloatArray, acceleration: FloatArray, support: IntArray
    ) -> Tangents:
        """Its derivatives; see `InertialLaw.moving_tangents`."""
        bed, parts = self.bed, self.bed.parts(deformation, support)
        moved = self._moved(deformation, support, parts.contact)
        total = parts.load + parts.damping * rate
        total = total + moved.mass * acceleration + 0.5 * moved.slope * rate * rate
        lifted = total < parts.contact.least
        by_deformation = parts.tangent + parts.damping_slope * rate
        by_deformation += moved.slope * acceleration + 0.5 * moved.bend * rate * rate
        by_rate = parts.damping + moved.slope * rate
        return Tangents(
            stiffness=np.where(lifted, 0.0, by_deformation) - bed.linear_stiffness,
            damping=np.where(lifted, 0.0, by_rate) - bed.linear_damping,
            mass=np.where(lifted, 0.0, moved.mass) + self.sleeper_mass[support],
        )

    def _moved(self, deformation: FloatArray, support: IntArray, contact: Contact) -> _Mass:
        bed = self.bed
        x = deformation - bed.factors.gap[support]
        mass, slope, bend = np.full_like(x, self.mass), np.zeros_like(x), np.zeros_like(x)
        if self.grows:
            jet, scale = bed.characteristic.jet(x), self.mass / bed.linear_stiffness
            excess, excess_slope = secant(x, jet)
            small = np.abs(x) < TINY
            bend = (jet.curvature - 2.0 * excess_slope) / np.where(small, 1.0, x)
            there = bed.linear_stiffness + excess > 0.0
            mass = np.where(there, scale * (bed.linear_stiffness + excess), 0.0)
            slope = np.where(there, scale * excess_slope, 0.0)
            bend = np.where(there & ~small, scale * bend, 0.0)
        return _Mass(
            contact.share * mass,
            contact.share * slope + contact.slope * mass,
            contact.share * bend + 2.0 * contact.slope * slope + contact.bend * mass,
        )
