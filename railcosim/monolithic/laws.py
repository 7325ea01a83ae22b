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
    load: tuple[Array, Array], damping: Damping, rate: Array, *, loose: NDArray[np.bool_]
) -> Tangent:
    """Add both forces; where things are loose, only what presses is left.

    Parameters
    ----------
    load : tuple of ndarray, shape (n,)
        Of the spring [N], and its derivative [N/m].
    damping : Damping
        Of the damper, which has set in as far as it does.
    rate : ndarray, shape (n,)
        [m/s].
    loose : ndarray of bool, shape (n,)
        What cannot pull.
    """
    force = load[0] + damping.coefficient * rate
    left = ~(loose & (force < 0.0))
    return Tangent(
        left * force, left * (load[1] + damping.slope * rate), left * damping.coefficient
    )


def setting_in(damping: Damping, compression: Array, *, loose: NDArray[np.bool_]) -> Damping:
    """Let dampers of what is loose set in over `ONSET` and be gone without compression."""
    share = np.clip(compression / ONSET, 0.0, 1.0)
    rise = ((compression > 0.0) & (compression < ONSET)) / ONSET
    return Damping(
        np.where(loose, share, 1.0) * damping.coefficient,
        np.where(loose, share * damping.slope + rise * damping.coefficient, damping.slope),
    )


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
        """Return the force under sleepers that sink [m] at a rate [m/s], (supports,) each."""
        own = self.supports
        compression = sinking - own.gap
        jet = self.curve.jet(compression)
        there = ~own.sleeper_lifts | (compression > 0.0)
        stiffness = there * own.ballast_stiffness
        damper = setting_in(self._damping(compression), compression, loose=own.sleeper_lifts)
        return spring_and_damper(
            (stiffness * jet.load, stiffness * jet.slope),
            Damping(*(there * own.ballast_damping * part for part in damper)),
            rate,
            loose=own.sleeper_lifts,
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
