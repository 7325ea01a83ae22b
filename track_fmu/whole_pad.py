"""Pads by their whole force; the increment is what the linear one lacks."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from typing import Self

from .assembly import IntArray
from .beam_element import FloatArray
from .support_factors import SupportFactors


@dataclass(frozen=True, slots=True, kw_only=True)
class WholePad(ABC):
    """Increment ``total - k x - c x'`` of Eq. (20), which works for every support.

    Parameters
    ----------
    linear_stiffness, linear_damping : float
        Of the pads in the modal model, ``k`` and ``c`` [N/m], [N s/m].
    factors : SupportFactors
        Of the supports.
    """

    linear_stiffness: float
    linear_damping: float
    factors: SupportFactors

    @abstractmethod
    def total(
        self, deformation: FloatArray, rate: FloatArray, support: IntArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Whole force [N] and its derivatives by deformation and rate [N/m], [N s/m], (c,) each."""

    @property
    def stiff(self) -> bool:
        """Yes; see `ComponentLaw.stiff`."""
        return True

    def moved(self, first: int, count: int) -> Self:
        """Return the law of other supports; see `ComponentLaw.moved`."""
        return replace(self, factors=self.factors.window(first, count))

    def force(self, deformation: FloatArray, rate: FloatArray, support: IntArray) -> FloatArray:
        """Force increment [N]; see `ComponentLaw.force`."""
        total, _, _ = self.total(deformation, rate, support)
        return total - self.linear_stiffness * deformation - self.linear_damping * rate

    def stiffness(self, deformation: FloatArray, rate: FloatArray, support: IntArray) -> FloatArray:
        """Derivative by the deformation [N/m]; see `ComponentLaw.stiffness`."""
        _, by_deformation, _ = self.total(deformation, rate, support)
        return by_deformation - self.linear_stiffness

    def damping(self, deformation: FloatArray, rate: FloatArray, support: IntArray) -> FloatArray:
        """Derivative by the rate [N s/m]; see `ComponentLaw.damping`."""
        _, _, by_rate = self.total(deformation, rate, support)
        return by_rate - self.linear_damping
