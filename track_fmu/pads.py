"""State-dependent rail pads, Eq. (20)-(23)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .assembly import IntArray
from .beam_element import FloatArray

Characteristic = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True, slots=True, kw_only=True)
class CharacteristicPad:
    """Pad given by its whole load-displacement and load-velocity characteristics.

    The increment of Eq. (20) is ``f(x) - k_lin x + g(x') - c_lin x'``: the linear part is in the
    modal model already.

    Parameters
    ----------
    spring, spring_stiffness : callable
        ``f(x)`` [N] and ``df/dx`` [N/m] for the pad compression ``x`` [m].
    damper, damper_damping : callable
        ``g(x')`` [N] and ``dg/dx'`` [N s/m] for the compression rate [m/s].
    linear_stiffness, linear_damping : float
        Of the pads in the modal model [N/m], [N s/m].
    """

    spring: Characteristic
    spring_stiffness: Characteristic
    damper: Characteristic
    damper_damping: Characteristic
    linear_stiffness: float
    linear_damping: float

    def force(self, deformation: FloatArray, rate: FloatArray, support: IntArray) -> FloatArray:
        """Force increment [N], Eq. (20); see `ComponentLaw.force`."""
        del support
        linear = self.linear_stiffness * deformation + self.linear_damping * rate
        return self.spring(deformation) + self.damper(rate) - linear

    def stiffness(self, deformation: FloatArray, support: IntArray) -> FloatArray:
        """Tangent stiffness of the increment [N/m]; see `ComponentLaw.stiffness`."""
        del support
        return self.spring_stiffness(deformation) - self.linear_stiffness

    def damping(self, deformation: FloatArray, support: IntArray) -> FloatArray:
        """Damping of the increment at rest [N s/m]; see `ComponentLaw.damping`."""
        del support
        return self.damper_damping(np.zeros_like(deformation)) - self.linear_damping
