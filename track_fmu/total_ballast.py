"""Ballast by its whole force, support by support; the increment is what the linear one lacks."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from .assembly import IntArray
from .beam_element import FloatArray
from .characteristics import Characteristic
from .component_law import MemorylessLaw
from .support_factors import SupportFactors

ONSET = 20e-6
"""Closure over which the damping sets in of ballast from which a sleeper can lift off [m]."""
TINY = 1e-12  # m; below it a secant is a tangent


class _Parts(NamedTuple):
    """Elastic force, damping coefficient, their slopes, and whether the ballast is there."""

    load: FloatArray
    tangent: FloatArray
    damping: FloatArray
    damping_slope: FloatArray
    loose: FloatArray


@dataclass(frozen=True, slots=True, kw_only=True)
class TotalBallast(MemorylessLaw):
    """Increment ``total(x - gap, x') - k x - c x'`` of Eq. (24), which works for every support.

    The total is ``f_k e(x) + f_c d(x) x'`` with the whole characteristic ``e = k x + e_inc(x)`` and
    the damping ``d = tau e / x`` (secant, Eq. (30)) or ``tau e'`` (tangent), ``tau = c / k``. Where
    a sleeper can lift off, that is with a gap or if the ballast does not pull, the total is zero
    for ``x < gap``, never negative, and the damping sets in over `ONSET` so that nothing jumps.

    Parameters
    ----------
    characteristic : Characteristic
        ``e_inc``: load less that of the linear spring.
    linear_stiffness, linear_damping : float
        Of the linear ballast, ``k`` and ``c`` [N/m], [N s/m].
    factors : SupportFactors
        Of the supports.
    tangent_damping : bool
        Which of the two dampings.
    pulls : bool
        Whether a lifted sleeper is pulled back, as in the paper's model.
    """

    characteristic: Characteristic
    linear_stiffness: float
    linear_damping: float
    factors: SupportFactors
    tangent_damping: bool = False
    pulls: bool = True

    @property
    def stiff(self) -> bool:
        """Yes; see `ComponentLaw.stiff`."""
        return True

    def moved(self, first: int, count: int) -> TotalBallast:
        """Return the law of other supports; see `ComponentLaw.moved`."""
        return replace(self, factors=self.factors.window(first, count))

    def force(self, deformation: FloatArray, rate: FloatArray, support: IntArray) -> FloatArray:
        """Force increment [N]; see `ComponentLaw.force`."""
        parts = self._parts(deformation, support)
        total = parts.load + parts.damping * rate
        total = np.where((parts.loose > 0.0) & (total < 0.0), 0.0, total)
        linear = self.linear_stiffness * deformation + self.linear_damping * rate
        return np.asarray(total - linear)

    def stiffness(self, deformation: FloatArray, rate: FloatArray, support: IntArray) -> FloatArray:
        """Derivative by the deformation [N/m]; see `ComponentLaw.stiffness`."""
        parts = self._parts(deformation, support)
        by_deformation = parts.tangent + parts.damping_slope * rate
        lifted = (parts.loose > 0.0) & (parts.load + parts.damping * rate < 0.0)
        return np.where(lifted, 0.0, by_deformation) - self.linear_stiffness

    def damping(self, deformation: FloatArray, rate: FloatArray, support: IntArray) -> FloatArray:
        """Derivative by the rate [N s/m]; see `ComponentLaw.damping`."""
        parts = self._parts(deformation, support)
        lifted = (parts.loose > 0.0) & (parts.load + parts.damping * rate < 0.0)
        return np.where(lifted, 0.0, parts.damping) - self.linear_damping

    def _parts(self, deformation: FloatArray, support: IntArray) -> _Parts:
        of, k, c = self.factors, self.linear_stiffness, self.linear_damping
        gap = of.gap[support]
        x = deformation - gap
        load, tangent, curvature = self.characteristic.jet(x)
        tau = c / k
        if self.tangent_damping:
            excess, slope = tangent, curvature
        else:
            small = np.abs(x) < TINY
            safe = np.where(small, 1.0, x)
            excess = np.where(small, tangent, load / safe)
            slope = np.where(small, 0.5 * curvature, (tangent - excess) / safe)
        damping = c + tau * excess
        damping_slope = tau * slope
        loose = np.where((gap > 0.0) | (not self.pulls), 1.0, 0.0)
        share = np.minimum(np.maximum(x, 0.0) / ONSET, 1.0)
        share_slope = np.where((x > 0.0) & (x < ONSET), 1.0 / ONSET, 0.0)
        damping_slope = np.where(
            loose > 0.0, share * damping_slope + share_slope * damping, damping_slope
        )
        damping = np.where(loose > 0.0, share * damping, damping)
        gone = (loose > 0.0) & ~(x > 0.0)
        stiff_factor = np.where(gone, 0.0, of.ballast_stiffness[support])
        damp_factor = np.where(gone, 0.0, of.ballast_damping[support])
        return _Parts(
            stiff_factor * (k * x + load),
            stiff_factor * (k + tangent),
            damp_factor * damping,
            damp_factor * damping_slope,
            loose,
        )
