"""Whole forces of pads on all supports: with spring and damper, or with a branch that relaxes.

Of the three-parameter pad, Eq. (20)-(23), a table gives ``k0(P)``, ``k1(P)`` and ``c1(P)``. With
the load at rest, ``dP/dx = k0``, and the primitive ``B`` of ``k1`` along it, ``dB/dx = k1``, the
force in the branch is ``s = B(x) - m``, and its memory ``m`` follows ``m' = s k1 / c1``: no rate of
the compression is needed.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, NamedTuple, Protocol

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from .curves import PiecewiseCurve
from .laws import ONSET, Damping, Tangent, setting_in, spring_and_damper

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from .curves import Curve
    from .support_properties import SupportProperties

    Array = NDArray[np.float64]

PARTS = 32
"""Parts of the load between two rows of a table: their cubic pieces are exact to 1e-8."""


class Relaxation(NamedTuple):
    """How memories change [N/s], with the derivatives by compression and memory, (n,) each."""

    rate: Array
    by_displacement: Array
    by_memory: Array


class PadLaw(Protocol):
    """Forces of the pads on all supports, (supports,) each."""

    @property
    def memories(self) -> int:
        """How many memories there are: as many as supports, or none."""
        ...

    @property
    def memory_scale(self) -> float:
        """By how much a memory changes under one metre [N]."""
        ...

    def tangent(self, compression: Array, rate: Array, memory: Array) -> Tangent:
        """Return forces at compressions [m], rates [m/s] and memories [N]."""
        ...

    def relaxed(self, compression: Array) -> Array:
        """Return the memories of pads that have been at rest for long [N], (memories,)."""
        ...

    def relaxation(self, compression: Array, memory: Array) -> Relaxation:
        """Return how memories change."""
        ...

    def branches(self, compression: Array) -> tuple[Array, Array]:
        """Return stiffness [N/m] and damping [N s/m] of the branches, 0 where there is none."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ElasticPads:
    """Pads with a load at rest and a linear damper; see `PadLaw`.

    Attributes
    ----------
    curve : Curve
        Nominal load.
    supports : SupportProperties
        What differs from support to support.
    """

    curve: Curve
    supports: SupportProperties
    memories: ClassVar[int] = 0
    memory_scale: ClassVar[float] = 1.0

    def tangent(self, compression: Array, rate: Array, memory: Array) -> Tangent:
        """See `PadLaw.tangent`."""
        del memory
        own = self.supports
        jet = self.curve.jet(compression)
        there = ~own.rail_lifts | (compression > 0.0)
        spring = there * own.pad_stiffness
        damper = Damping(there * own.own.pad_damping, np.zeros_like(compression))
        share = np.where(own.rail_lifts, compression / ONSET, 1.0)
        return spring_and_damper(
            (spring * jet.load, spring * jet.slope),
            setting_in(damper, share, np.full_like(share, 1.0 / ONSET)),
            rate,
            least=np.where(own.rail_lifts, 0.0, -np.inf),
        )

    def relaxed(self, compression: Array) -> Array:
        """See `PadLaw.relaxed`."""
        return compression[:0]

    def relaxation(self, compression: Array, memory: Array) -> Relaxation:
        """See `PadLaw.relaxation`."""
        del compression  # there is no memory: empty arrays
        return Relaxation(memory, memory, memory)

    def branches(self, compression: Array) -> tuple[Array, Array]:
        """See `PadLaw.branches`."""
        return np.zeros_like(compression), np.zeros_like(compression)


class RelaxingPads:
    """Three-parameter pads whose parameters depend on the preload; see `PadLaw`.

    Parameters
    ----------
    columns : mapping of str to ndarray, shape (rows,)
        ``preload`` [N], ``static_stiffness``, ``branch_stiffness`` [N/m], ``branch_damping``
        [N s/m]; straight lines between the rows, constant beyond them.
    clip_preload : float
        Of a pad under the unloaded rail [N].
    supports : SupportProperties
        What differs from support to support.
    """

    def __init__(
        self, columns: Mapping[str, Array], *, clip_preload: float, supports: SupportProperties
    ) -> None:
        self.supports = supports
        self._clip, self._preload = clip_preload, columns["preload"]
        self._damping = columns["branch_damping"]
        self._damping_rise = np.concatenate(
            ([0.0], np.diff(self._damping) / np.diff(self._preload), [0.0])
        )
        self._load, self._primitive = _along_the_load(columns, clip_preload)
        own = supports
        self._branched = (own.pad_stiffness > 0.0) & (own.pad_damping > 0.0)
        self.memories = len(own.gap)
        self.memory_scale = float((columns["static_stiffness"] + columns["branch_stiffness"]).max())

    def tangent(self, compression: Array, rate: Array, memory: Array) -> Tangent:
        """See `PadLaw.tangent`."""
        x = self._pressed(compression)
        spring, branch = self.supports.pad_stiffness, self._branched * self.supports.pad_stiffness
        load, primitive = self._load.jet(x), self._primitive.jet(x)
        force = spring * load.load + branch * primitive.load - self._branched * memory
        there = ~self.supports.rail_lifts | (compression > 0.0)
        return spring_and_damper(
            (there * force, there * (spring * load.slope + branch * primitive.slope)),
            Damping(np.zeros_like(x), np.zeros_like(x)),
            rate,
            least=np.where(self.supports.rail_lifts, 0.0, -np.inf),
        )

    def relaxed(self, compression: Array) -> Array:
        """See `PadLaw.relaxed`."""
        primitive = self._primitive.jet(self._pressed(compression))
        return np.asarray(self._branched * self.supports.pad_stiffness * primitive.load)

    def relaxation(self, compression: Array, memory: Array) -> Relaxation:
        """See `PadLaw.relaxation`."""
        x = self._pressed(compression)
        moves = ~self.supports.rail_lifts | (compression > 0.0)
        spring = self._branched * self.supports.pad_stiffness
        branch = self._primitive.jet(x)
        damping, damping_slope = self._dashpot(x)
        pace = spring * branch.slope / damping  # 1/s
        pace_slope = spring * branch.curvature / damping - pace * damping_slope / damping
        force = spring * branch.load - self._branched * memory
        by_displacement = pace_slope * force + pace * spring * branch.slope
        return Relaxation(pace * force, moves * by_displacement, -pace)

    def branches(self, compression: Array) -> tuple[Array, Array]:
        """See `PadLaw.branches`."""
        x = self._pressed(compression)
        there = self._branched & (~self.supports.rail_lifts | (compression > 0.0))
        stiffness = self.supports.pad_stiffness * self._primitive.jet(x).slope
        return there * stiffness, there * self._dashpot(x)[0]

    def _pressed(self, compression: Array) -> Array:
        return np.where(self.supports.rail_lifts, np.maximum(compression, 0.0), compression)

    def _dashpot(self, x: Array) -> tuple[Array, Array]:
        """Damping of the branches, 1 where there is none, and its derivative by compression."""
        load = self._load.jet(x)
        preload = load.load + self._clip
        factor = np.where(self._branched, self.supports.pad_damping, 0.0)
        rise = self._damping_rise[np.searchsorted(self._preload, preload, side="right")]
        damping = np.interp(preload, self._preload, self._damping)
        return (
            np.where(self._branched, factor * damping, 1.0),
            factor * rise * load.slope,
        )


def _along_the_load(
    columns: Mapping[str, Array], clip_preload: float
) -> tuple[PiecewiseCurve, PiecewiseCurve]:
    """Return load beyond the clip's preload, and primitive of ``k1``, over the compression.

    Both by quadrature over the load: ``dx = dP / k0`` and ``dB = k1 / k0 dP``.
    """
    rows = columns["preload"]
    load = np.unique(
        np.concatenate((np.linspace(rows[:-1], rows[1:], PARTS + 1).ravel(), [clip_preload]))
    )

    def at(preload: Array, name: str) -> Array:
        return np.interp(preload, rows, columns[name])

    places, weights = np.polynomial.legendre.leggauss(4)
    middle, half = 0.5 * (load[1:] + load[:-1]), 0.5 * np.diff(load)
    inside = middle[:, None] + half[:, None] * places
    softness = 1.0 / at(inside, "static_stiffness")
    compression, primitive = (
        np.concatenate(([0.0], np.cumsum(half * (integrand @ weights))))
        for integrand in (softness, softness * at(inside, "branch_stiffness"))
    )
    begin = int(np.searchsorted(load, clip_preload))
    compression, primitive = compression - compression[begin], primitive - primitive[begin]
    stiffnesses = at(load, "static_stiffness"), at(load, "branch_stiffness")
    first, second = (
        PiecewiseCurve(CubicHermiteSpline(compression, values, slope))
        for values, slope in zip((load - clip_preload, primitive), stiffnesses, strict=True)
    )
    return first, second
