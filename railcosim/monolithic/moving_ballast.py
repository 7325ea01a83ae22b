"""Ballast that moves along with the sleepers, the more of it the harder it is pressed.

Its kinetic energy ``m(x) x'^2 / 2`` asks for the force ``m x'' + m_x x'^2 / 2``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from .laws import NEARLY_NOTHING

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .curves import Curve
    from .support_properties import SupportProperties

    Array = NDArray[np.float64]


class Mass(NamedTuple):
    """Mass [kg] with its first and second derivative by the sinking [kg/m], [kg/m2]."""

    mass: Array
    slope: Array
    curvature: Array


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MovingBallast:
    """Mass of the ballast under every sleeper, as docs/supports.md defines it.

    Attributes
    ----------
    curve : Curve
        Nominal load at rest over the compression.
    stiffness : float
        Of the unloaded linear ballast [N/m].
    mass : float
        Of what moves along with an unloaded rail seat [kg].
    grows : bool
        Whether the mass grows with the secant of the load.
    supports : SupportProperties
        What differs from support to support.
    """

    curve: Curve
    stiffness: float
    mass: float
    grows: bool
    supports: SupportProperties

    @property
    def varies(self) -> bool:
        """Whether the mass depends on the sinking."""
        return self.grows and self.mass > 0.0

    def at(self, sinking: Array) -> Mass:
        """Return the mass under sleepers that sink [m] and cannot lift off, (supports,)."""
        still = np.zeros_like(sinking)
        if not self.grows:
            return Mass(np.full_like(sinking, self.mass), still, still)
        x = sinking - self.supports.gap
        load, slope, curvature = self.curve.jet(x)
        near = np.abs(x) < NEARLY_NOTHING
        way = np.where(near, 1.0, x)
        secant = np.where(near, slope, load / way)
        by_way = np.where(near, 0.5 * curvature, (slope - secant) / way)
        bend = np.where(near, 0.0, (curvature - 2.0 * by_way) / way)
        share = np.where(secant > 0.0, self.mass / self.stiffness, 0.0)
        return Mass(share * secant, share * by_way, share * bend)
