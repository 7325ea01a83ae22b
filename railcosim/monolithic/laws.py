"""Forces over displacement and rate with their derivatives: Hertz's contact, ballast, pads."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .curves import Curve
    from .support_properties import SupportProperties

    Array = NDArray[np.float64]

ONSET = 20e-6
"""Compression over which dampers set in where something can lift off [m]; see docs/supports.md."""

NEARLY_NOTHING = 1e-12
"""Displacement within which a secant is a tangent [m]."""


class Tangent(NamedTuple):
    """A force and its derivatives, each of shape (n,) or (n, times).

    Attributes
    ----------
    force : ndarray
        [N].
    stiffness, damping : ndarray
        By displacement [N/m] and by velocity [N s/m].
    """

    force: Array
    stiffness: Array
    damping: Array


@dataclass(frozen=True, slots=True, kw_only=True)
class HertzLaw:
    """Force over compression, without tension.

    Attributes
    ----------
    coefficient : float
        C_H [N/m^1.5].
    """

    coefficient: float

    def tangent(self, compression: Array) -> Tangent:
        """Return ``C_H max(0, delta)^1.5`` and its derivative by delta."""
        root = np.sqrt(np.maximum(compression, 0.0))
        stiffness = 1.5 * self.coefficient * root
        return Tangent(self.coefficient * root**3, stiffness, np.zeros_like(stiffness))

    def compression(self, force: float) -> float:
        """Return the compression [m] under a force [N]."""
        return float(np.cbrt(force / self.coefficient)) ** 2


class Damping(NamedTuple):
    """Coefficient of a damper [N s/m] and its derivative by the displacement [N s/m2]."""

    coefficient: Array
    slope: Array


def spring_and_damper(
    load: tuple[Array, Array], damping: Damping, rate: Array, *, least: Array
) -> Tangent:
    """Add both forces, as far as they can be borne.

    Parameters
    ----------
    load : tuple of ndarray, shape (n,)
        Of the spring [N], and its derivative [N/m].
    damping : Damping
        Of the damper, which has set in as far as it does.
    rate : ndarray, shape (n,)
        [m/s].
    least : ndarray, shape (n,)
        Least force [N]; minus infinity where all is borne.
    """
    force = load[0] + damping.coefficient * rate
    left = ~(force < least)
    return Tangent(
        np.where(left, force, least),
        left * (load[1] + damping.slope * rate),
        left * damping.coefficient,
    )


def setting_in(damping: Damping, share: Array, slope: Array) -> Damping:
    """Let dampers set in to shares from 0 to 1, which change so much with displacement [1/m]."""
    share, slope = np.clip(share, 0.0, 1.0), ((share > 0.0) & (share < 1.0)) * slope
    return Damping(share * damping.coefficient, share * damping.slope + slope * damping.coefficient)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BallastLaw:
    """Whole force of the ballast under every sleeper.

    Its damping follows the stiffness, Eq. (29) and (30): ``tau`` times the secant or the tangent of
    the load.

    Attributes
    ----------
    curve : Curve
        Nominal load at rest over the compression.
    tau : float
        Damping over stiffness of the unloaded ballast [s].
    tangent_damping : bool
        Whether damping follows the tangent, not the secant.
    supports : SupportProperties
        What differs from support to support.
    """

    curve: Curve
    tau: float
    tangent_damping: bool
    supports: SupportProperties

    def tangent(self, sinking: Array, rate: Array) -> Tangent:
        """Return the force under sleepers that sink [m] at a rate [m/s], (supports,) each.

        It is counted from the track at rest; what lies on the ballast then can be taken off it.
        """
        own = self.supports
        compression = sinking - own.gap
        jet = self.curve.jet(compression)
        load, slope = own.ballast_stiffness * jet.load, own.ballast_stiffness * jet.slope
        onset = ONSET * own.own.ballast_stiffness
        onset = np.where(own.dead_load > 0.0, np.minimum(onset, own.dead_load), onset)
        onset = np.where(onset > 0.0, onset, 1.0)
        pressed = np.where(own.sleeper_lifts, load + own.dead_load, onset)
        there = pressed > 0.0
        damper = setting_in(
            self._damping(compression),
            pressed / onset,
            np.where(own.sleeper_lifts, slope, 0.0) / onset,
        )
        return spring_and_damper(
            (np.where(there, load, -own.dead_load), there * slope),
            Damping(*(own.ballast_damping * part for part in damper)),
            rate,
            least=np.where(own.sleeper_lifts, -own.dead_load, -np.inf),
        )

    def _damping(self, compression: Array) -> Damping:
        """Nominal damping of ballast that is in contact."""
        load, slope, curvature = self.curve.jet(compression)
        if self.tangent_damping:
            return Damping(self.tau * slope, self.tau * curvature)
        near = np.abs(compression) < NEARLY_NOTHING
        x = np.where(near, 1.0, compression)
        secant = np.where(near, slope, load / x)
        return Damping(
            self.tau * secant, self.tau * np.where(near, 0.5 * curvature, (slope - secant) / x)
        )
