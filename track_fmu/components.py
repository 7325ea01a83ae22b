"""The state-dependent components of the track: ballast under and pads on every sleeper."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .assembly import IntArray
from .beam_element import FloatArray
from .component_law import ComponentLaw
from .eigensolver import ComplexArray
from .reduction import ReducedTrack


@dataclass(frozen=True, slots=True)
class _Group:
    """Components that obey one law: their places among the active ones, and their supports."""

    law: ComponentLaw
    part: slice
    support: IntArray


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
    """

    def __init__(self, track: ReducedTrack, groups: list[_Group], number: IntArray) -> None:
        self.number = number
        self.rows = track.ballast_rows.start + number
        self.shape: ComplexArray = track.shape[self.rows]
        self.flexibility: FloatArray = track.flexibility[np.ix_(self.rows, self.rows)]
        self._groups = groups

    @property
    def count(self) -> int:
        """Number of active components c."""
        return len(self.number)

    def force(self, deformation: FloatArray, rate: FloatArray) -> FloatArray:
        """Force increments [N], shape (c,)."""
        total = np.empty(self.count)
        for group in self._groups:
            part = group.part
            total[part] = group.law.force(deformation[part], rate[part], group.support)
        return total

    def stiffness(self, deformation: FloatArray) -> FloatArray:
        """Tangent stiffness of the increments at rest [N/m], shape (c,)."""
        total = np.empty(self.count)
        for group in self._groups:
            total[group.part] = group.law.stiffness(deformation[group.part], group.support)
        return total

    def damping(self, deformation: FloatArray) -> FloatArray:
        """Tangent damping of the increments at rest [N s/m], shape (c,)."""
        total = np.empty(self.count)
        for group in self._groups:
            total[group.part] = group.law.damping(deformation[group.part], group.support)
        return total


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
        self._last: tuple[tuple[int, ...], ActiveComponents] | None = None

    def active(self, supports: tuple[int, ...]) -> ActiveComponents:
        """Components with a law at the given supports (numbers from 0)."""
        if self._last is None or self._last[0] != supports:
            self._last = supports, self._select(np.array(supports, dtype=np.intp))
        return self._last[1]

    def _select(self, support: IntArray) -> ActiveComponents:
        groups: list[_Group] = []
        numbers: list[IntArray] = []
        for kind, law in enumerate(self._laws):
            if law is not None:
                first = len(support) * len(groups)
                groups.append(_Group(law, slice(first, first + len(support)), support))
                numbers.append(support + kind * self._track.parameters.supports)
        number = np.concatenate(numbers) if numbers else np.zeros(0, dtype=np.intp)
        return ActiveComponents(self._track, groups, number)
