"""State-dependent rail pads, Eq. (20)-(23), by their whole force, support by support."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .assembly import IntArray
from .beam_element import FloatArray
from .characteristics import Characteristic
from .component_law import MemorylessLaw
from .whole_pad import WholePad

ONSET = 20e-6
"""Compression over which the damping sets in of a pad from which the rail can lift off [m]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TotalPad(WholePad, MemorylessLaw):
    """Increment ``f_k e(x) + f_c c x' - k x - c x'`` of Eq. (20), which works for every support.

    Without a fastening the rail can lift off: then the total is zero for ``x < 0``, never negative,
    and the damping sets in over `ONSET`.

    Parameters
    ----------
    characteristic : Characteristic
        ``e - k x``: load less that of the linear spring.
    linear_stiffness, linear_damping, factors
        See `WholePad`.
    """

    characteristic: Characteristic

    def total(
        self, deformation: FloatArray, rate: FloatArray, support: IntArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Whole force and its derivatives; see `WholePad.total`."""
        x = deformation
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
