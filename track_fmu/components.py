"""The state-dependent components of the track: ballast under and pads on every sleeper."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass, replace

import numpy as np

from .assembly import IntArray
from .beam_element import FloatArray
from .component_law import ComponentLaw
from .eigensolver import ComplexArray
from .pad_memory import PadMemory
from .reduction import ReducedTrack


@dataclass(frozen=True, slots=True)
class _Group:
    """Components that obey one law: their places among the active ones, and their supports."""

    law: ComponentLaw
    part: slice
    support: IntArray

    def during(self, step_size: float, memory: PadMemory) -> _Group:
        """Return the group over a step; itself if its law has no memory."""
        law = self.law.during(step_size, memory)
        return self if law is self.law else replace(self, law=law)


class ActiveComponents:
    """The components near the wheels whose force increments are accounted for.

    Attributes
    ----------
    number : (c,) int array
        Numbers among all components: ballast first, then pads.
    rows : (c,) int array
        Their coordinates.
    shape : (c, S) complex array
        Modal deformations.
    flexibility : (c, c) float array
        Residual flexibility among them [m/N].
    first_support : int
        How many supports there are before the one of number 0, which are none but on an endless
        track.
    remembers : bool
        Whether a law of theirs, bound to a step, has a memory.
    """

    def __init__(
        self, track: ReducedTrack, groups: list[_Group], number: IntArray, first_support: int
    ) -> None:
        self.number, self.first_support = number, first_support
        self.rows = track.ballast_rows.start + number
        self.shape: ComplexArray = track.shape[self.rows]
        self.flexibility: FloatArray = track.flexibility[np.ix_(self.rows, self.rows)]
        self._groups = groups
        self.remembers = False

    @property
    def count(self) -> int:
        """Number of active components c."""
        return len(self.number)

    @property
    def stiff(self) -> bool:
        """Whether a law among theirs is; see `ComponentLaw.stiff`."""
        return any(group.law.stiff for group in self._groups)

    def force(self, deformation: FloatArray, rate: FloatArray) -> FloatArray:
        """Force increments [N], shape (c,)."""
        total = np.empty(self.count)
        for group in self._groups:
            part = group.part
            total[part] = group.law.force(deformation[part], rate[part], group.support)
        return total

    def stiffness(self, deformation: FloatArray, rate: FloatArray) -> FloatArray:
        """Tangent stiffness of the increments [N/m], shape (c,)."""
        total = np.empty(self.count)
        for group in self._groups:
            part = group.part
            total[part] = group.law.stiffness(deformation[part], rate[part], group.support)
        return total

    def damping(self, deformation: FloatArray, rate: FloatArray) -> FloatArray:
        """Tangent damping of the increments [N s/m], shape (c,)."""
        total = np.empty(self.count)
        for group in self._groups:
            part = group.part
            total[part] = group.law.damping(deformation[part], rate[part], group.support)
        return total

    def during(self, step_size: float, memory: PadMemory) -> ActiveComponents:
        """Return the same components over a step [s] that begins with a memory."""
        groups = [group.during(step_size, memory) for group in self._groups]
        if all(new is old for new, old in zip(groups, self._groups, strict=True)):
            return self
        bound = copy(self)
        bound.bind(groups)
        return bound

    def bind(self, groups: list[_Group]) -> None:
        """Take over laws that hold for one step."""
        self._groups, self.remembers = groups, True

    def remember(self, memory: PadMemory, deformation: FloatArray, rate: FloatArray) -> None:
        """Keep what the components remember of the motion at the end of the step."""
        memory.forget()
        for group in self._groups:
            part = group.part
            values = group.law.remembered(deformation[part], rate[part], group.support)
            if values:
                memory.keep(group.support, *values)


class Components:
    """All pads and ballast of a track, with the laws of those that are state-dependent.

    Parameters
    ----------
    track : ReducedTrack
        The track.
    ballast, pad : ComponentLaw or None
        Laws of the increments; None is linear, that is without increment.
    """

    def __init__(
        self, track: ReducedTrack, *, ballast: ComponentLaw | None, pad: ComponentLaw | None
    ) -> None:
        self.count = 2 * track.parameters.supports
        self._track = track
        self._laws = (ballast, pad)
        self._last: tuple[tuple[int, ...], int | None, ActiveComponents] | None = None

    def active(self, supports: tuple[int, ...], window: int | None = None) -> ActiveComponents:
        """Components with a law at the given supports.

        Parameters
        ----------
        supports : tuple of int
            Numbers of the supports, from 0.
        window : int or None
            Bays before the window of an endless track, from which its supports are numbered; None
            for an ordinary one.
        """
        if self._last is None or self._last[:2] != (supports, window):
            active = self._select(np.array(supports, dtype=np.intp), window)
            self._last = supports, window, active
        return self._last[2]

    def _select(self, support: IntArray, window: int | None) -> ActiveComponents:
        groups: list[_Group] = []
        numbers: list[IntArray] = []
        count = self._track.parameters.supports
        for kind, law in enumerate(self._laws):
            if law is not None:
                here = law if window is None else law.moved(window, count)
                first = len(support) * len(groups)
                groups.append(_Group(here, slice(first, first + len(support)), support))
                numbers.append(support + kind * count)
        number = np.concatenate(numbers) if numbers else np.zeros(0, dtype=np.intp)
        return ActiveComponents(self._track, groups, number, window or 0)
