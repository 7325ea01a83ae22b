"""State-dependent force laws of pads and ballast: what the linear track does not account for."""

from __future__ import annotations

from typing import Protocol

from .assembly import IntArray
from .beam_element import FloatArray


class ComponentLaw(Protocol):
    """Force increment of a pad or of the ballast, on top of its linear spring and damper.

    Positive in compression. The increment resists the deformation: it enters the track as
    ``-force`` on the deformation, Eq. (23) and (25).
    """

    def force(self, deformation: FloatArray, rate: FloatArray, support: IntArray) -> FloatArray:
        """Force increment [N] at the given deformation [m] and rate [m/s].

        Parameters
        ----------
        deformation, rate : (c,) float array
            Of the components asked for.
        support : (c,) int array
            Support number of each (from 0), for laws that differ from support to support.
        """
        ...

    def stiffness(self, deformation: FloatArray, support: IntArray) -> FloatArray:
        """Derivative of the force increment by the deformation at rest [N/m], shape (c,)."""
        ...

    def damping(self, deformation: FloatArray, support: IntArray) -> FloatArray:
        """Derivative of the force increment by the rate at rest [N s/m], shape (c,)."""
        ...
