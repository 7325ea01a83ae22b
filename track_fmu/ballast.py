"""State-dependent ballast and subgrade under a rail seat, Eq. (26)-(30)."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np

from .assembly import IntArray
from .beam_element import FloatArray
from .component_law import MemorylessLaw


@dataclass(frozen=True, slots=True, kw_only=True)
class PolynomialBallast(MemorylessLaw):
    """Fourth-degree force increment with proportional (secant) damping.

    ``force = (alpha x^2 + beta x^3 + delta x^4) + tau x' (alpha x + beta x^2 + delta x^3)`` for a
    sleeper pressed down, ``x > 0``, and nothing for a lifted one, Eq. (27) and (30). The linear
    ballast of the modal model stays in force in both cases; it is *not* subtracted again.

    Parameters
    ----------
    alpha, beta, delta : float
        Coefficients [N/m2], [N/m3], [N/m4].
    tau : float
        Damping over stiffness [s], ``c_b / k_b`` of the linear ballast, Eq. (29).
    """

    alpha: float = 0.37e12
    beta: float = -2.47e15
    delta: float = 5.75e18
    tau: float = 31e3 / 30e6

    def __post_init__(self) -> None:
        for field in fields(self):
            if not math.isfinite(getattr(self, field.name)):
                raise ValueError(
                    f"ballast: {field.name} = {getattr(self, field.name)!r} must be a finite number"
                )
        if self.tau < 0.0:
            raise ValueError(f"ballast: tau = {self.tau!r} s must be at least 0")

    @property
    def stiff(self) -> bool:
        """No; see `ComponentLaw.stiff`."""
        return False

    def moved(self, first: int, count: int) -> PolynomialBallast:
        """Return the same law; see `ComponentLaw.moved`."""
        del first, count
        return self

    def force(self, deformation: FloatArray, rate: FloatArray, support: IntArray) -> FloatArray:
        """Force increment [N], Eq. (27) + (30); see `ComponentLaw.force`."""
        del support  # every support is alike
        x = np.maximum(deformation, 0.0)
        return self._secant(x) * (x + self.tau * rate)

    def stiffness(self, deformation: FloatArray, rate: FloatArray, support: IntArray) -> FloatArray:
        """Tangent stiffness of Eq. (27), at rest [N/m]; see `ComponentLaw.stiffness`."""
        del rate, support
        x = np.maximum(deformation, 0.0)
        return x * (2.0 * self.alpha + x * (3.0 * self.beta + x * 4.0 * self.delta))

    def damping(self, deformation: FloatArray, rate: FloatArray, support: IntArray) -> FloatArray:
        """Damping of Eq. (30) [N s/m]; see `ComponentLaw.damping`."""
        del rate, support
        return self.tau * self._secant(np.maximum(deformation, 0.0))

    def _secant(self, x: FloatArray) -> FloatArray:
        """Secant stiffness, Eq. (27) over x [N/m]."""
        return x * (self.alpha + x * (self.beta + x * self.delta))


def secant_displacement(
    force: FloatArray, *, slope: float = 2e3, stiffness: float = 30e6
) -> FloatArray:
    """Sleeper displacement ``F / (slope F + stiffness)`` of the measured law Eq. (26) [m].

    Parameters
    ----------
    force : float array
        Force on the ballast under one rail seat, at least 0 [N].
    slope, stiffness : float
        Of the secant stiffness over the force [1/m], [N/m].
    """
    return np.asarray(force / (slope * force + stiffness))
