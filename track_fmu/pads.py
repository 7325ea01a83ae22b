"""State-dependent rail pads, Eq. (20)-(23), by their whole force, support by support."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .assembly import IntArray
from .beam_element import FloatArray
from .characteristics import Characteristic
from .component_law import MemorylessLaw
from .support_factors import SupportFactors

ONSET = 20e-6
"""Compression over which the damping sets in of a pad from which the rail can lift off [m]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TotalPad(MemorylessLaw):
    """Increment ``f_k e(x) + f_c c x' - k x - c x'`` of Eq. (20), which works for every support.

    Without a fastening the rail can lift off: then the total is zero for ``x < 0``, never negative,
    and the damping sets in over `ONSET`.

    Parameters
    ----------
    characteristic : Characteristic
        ``e - k x``: load less that of the linear spring.
    linear_stiffness, linear_damping : float
        Of the pads in the modal model, ``k`` and ``c`` [N/m], [N s/m].
    factors : SupportFactors
        Of the supports.
    """

    characteristic: Characteristic
    linear_stiffness: float
    linear_damping: float
    factors: SupportFactors

    @property
    def stiff(self) -> bool:
        """Yes; see `ComponentLaw.stiff`."""
        return True

    def moved(self, first: int, count: int) -> TotalPad:
        """Return the law of other supports; see `ComponentLaw.moved`."""
        return replace(self, factors=self.factors.window(first, count))

    def force(self, deformation: FloatArray, rate: FloatArray, support: IntArray) -> FloatArray:
        """Force increment [N]; see `ComponentLaw.force`."""
        total, _, _ = self._total(deformation, rate, support)
        return total - self.linear_stiffness * deformation - self.linear_damping * rate

    def stiffness(self, deformation: FloatArray, rate: FloatArray, support: IntArray) -> FloatArray:
        """Derivative by the deformation [N/m]; see `ComponentLaw.stiffness`."""
        _, by_deformation, _ = self._total(deformation, rate, support)
        return by_deformation - self.linear_stiffness

    def damping(self, deformation: FloatArray, rate: FloatArray, support: IntArray) -> FloatArray:
        """Derivative by the rate [N s/m]; see `ComponentLaw.damping`."""
        _, _, by_rate = self._total(deformation, rate, support)
        return by_rate - self.linear_damping

    def _total(
        self, x: FloatArray, rate: FloatArray, support: IntArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Whole force and its derivatives by deformation and rate."""
        load, tangent, _ = self.characteristic.jet(x)
        loose = self.factors.fastened[support] == 0.0
        share = np.where(loose, np.minimum(np.maximum(x, 0.0) / ONSET, 1.0), 1.0)
        share_slope = np.where(loose & (x > 0.0) & (x < ONSET), 1.0 / ONSET, 0.0)
        damper = self.factors.pad_damping[support] * self.linear_damping
        spring = self.factors.pad_stiffness[support]
        total = spring * (self.linear_stiffness * x + load) + share * damper * rate
        gone = loose & (~(x > 0.0) | (total < 0.0))
        by_deformation = spring * (self.linear_stiffness + tangent) + share_slope * damper * rate
        return (
            np.where(gone, 0.0, total),
            np.where(gone, 0.0, by_deformation),
            np.where(gone, 0.0, share * damper),
        )
