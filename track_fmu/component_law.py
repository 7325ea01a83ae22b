"""State-dependent force laws of pads and ballast: what the linear track does not account for."""

from __future__ import annotations

from typing import Protocol

from .assembly import IntArray
from .beam_element import FloatArray
from .pad_memory import PadMemory


class ComponentLaw(Protocol):
    """Force increment of a pad or of the ballast, on top of its linear spring and damper.

    Positive in compression. The increment resists the deformation: it enters the track as
    ``-force`` on the deformation, Eq. (23) and (25).

    Attributes
    ----------
    stiff : bool
        Whether tangents at the beginning of a step may be too far from those at its end, as where
        gaps close: they are then worked out again in every sweep.
    """

    @property
    def stiff(self) -> bool:
        """See the attribute."""
        ...

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

    def stiffness(self, deformation: FloatArray, rate: FloatArray, support: IntArray) -> FloatArray:
        """Derivative of the force increment by the deformation [N/m], shape (c,).

        A law that is not stiff may give it at rest, whatever the rate.
        """
        ...

    def damping(self, deformation: FloatArray, rate: FloatArray, support: IntArray) -> FloatArray:
        """Derivative of the force increment by the rate [N s/m], shape (c,)."""
        ...

    def moved(self, first: int, count: int) -> ComponentLaw:
        """Return the law of so many supports, from number ``first`` (from 0) on.

        Those that the window of an endless track holds; see `SupportFactors.window`. A law that is
        the same at every support is its own.
        """
        ...

    def during(self, step_size: float, memory: PadMemory) -> ComponentLaw:
        """Return the law over a step [s] that begins with what components remember.

        A law without memory is its own; one with memory is by itself that of slow motion.
        """
        ...

    def remembered(
        self, deformation: FloatArray, rate: FloatArray, support: IntArray
    ) -> tuple[FloatArray, ...]:
        """What the components remember of the motion at the end of the step, (c,) each.

        See `PadMemory.keep`; empty for a law without memory.
        """
        ...


class MemorylessLaw:
    """What all laws without memory have in common."""

    __slots__ = ()

    def during(self, step_size: float, memory: PadMemory) -> ComponentLaw:
        """Return the same law; see `ComponentLaw.during`."""
        del step_size, memory
        law: ComponentLaw = self  # type: ignore[assignment]  # of subclasses, which are laws
        return law

    def remembered(
        self, deformation: FloatArray, rate: FloatArray, support: IntArray
    ) -> tuple[FloatArray, ...]:
        """Nothing; see `ComponentLaw.remembered`."""
        del deformation, rate, support
        return ()
