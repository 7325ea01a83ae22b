"""The two nonlinear laws of the passage with their derivatives: Hertz's contact and the ballast."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..track_section import Track


class Tangent(NamedTuple):
    """A force and its derivatives, each of shape (n,) or (n, times).

    Attributes
    ----------
    force : ndarray
        [N].
    stiffness, damping : ndarray
        By displacement [N/m] and by velocity [N s/m].
    """

    force: NDArray[np.float64]
    stiffness: NDArray[np.float64]
    damping: NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class HertzLaw:
    """Force over compression, without tension.

    Attributes
    ----------
    coefficient : float
        C_H [N/m^1.5].
    """

    coefficient: float

    def tangent(self, compression: NDArray[np.float64]) -> Tangent:
        """Return ``C_H max(0, delta)^1.5`` and its derivative by delta."""
        root = np.sqrt(np.maximum(compression, 0.0))
        stiffness = 1.5 * self.coefficient * root
        return Tangent(self.coefficient * root**3, stiffness, np.zeros_like(stiffness))

    def compression(self, force: float) -> float:
        """Return the compression [m] under a force [N]."""
        return float(np.cbrt(force / self.coefficient)) ** 2


@dataclass(frozen=True, slots=True, kw_only=True)
class BallastLaw:
    """What ballast and subgrade bear on top of their linear spring and damper, Eq. (27) and (30).

    Attributes
    ----------
    alpha, beta, delta : float
        Coefficients of Eq. (27) [N/m2], [N/m3], [N/m4]; all zero is linear ballast.
    tau : float
        Damping over stiffness, Eq. (29) [s].
    """

    alpha: float
    beta: float
    delta: float
    tau: float

    def tangent(self, sinking: NDArray[np.float64], rate: NDArray[np.float64]) -> Tangent:
        """Return the sum of both forces on sleepers that sink [m] at a rate [m/s]."""
        x = np.maximum(sinking, 0.0)
        secant = x * (self.alpha + x * (self.beta + x * self.delta))
        slope = np.where(x > 0.0, self.alpha + x * (2.0 * self.beta + x * 3.0 * self.delta), 0.0)
        shifted = x + self.tau * rate
        return Tangent(secant * shifted, secant + slope * shifted, self.tau * secant)


def ballast_law(track: Track) -> BallastLaw:
    """Return the law of a scenario's ballast."""
    if track.ballast == "linear":
        return BallastLaw(alpha=0.0, beta=0.0, delta=0.0, tau=0.0)
    return BallastLaw(
        alpha=track.ballast_alpha,
        beta=track.ballast_beta,
        delta=track.ballast_delta,
        tau=track.ballast_damping / track.ballast_stiffness,
    )
