"""Viscoelastic pads on all supports: how their Maxwell branches go through a step.

Over a step of size h the compression runs on a straight line from x0 to x1. For parameters held at
those of its middle, the force s in the branch, ``s' = k1 (x' - s / c1)``, then ends exactly at

    s1 = exp(-z) s0 + k1 phi(z) (x1 - x0),   z = h k1 / c1,   phi(z) = (1 - exp(-z)) / z
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from .assembly import IntArray
from .beam_element import FloatArray
from .pad_memory import PadMemory
from .preloaded_pad import PreloadedPad
from .whole_pad import WholePad

SMALL = 1e-4
"""Ratio of step and relaxation time below which the derivative of phi is its series."""


class _Branch(NamedTuple):
    """Force in the branch at the end of a step and its derivative by the deformation there."""

    force: FloatArray
    stiffness: FloatArray


@dataclass(frozen=True, slots=True, kw_only=True)
class ViscoelasticPads(WholePad):
    """Increment ``f_k F(x) + s - k x - c x'`` of pads with a Maxwell branch, Eq. (20).

    By itself it is the law of slow motion, in which the branch is a dashpot, ``s = f_c c1 x'``;
    `during` gives that of a step. Pads that were not accounted for in the step before begin with
    a relaxed branch. Factors: ``f_k`` on ``k0`` and ``k1``, ``f_c`` on ``c1``. Without a fastening
    the pad is compressed by ``max(x, 0)`` and its force is never negative.

    Parameters
    ----------
    pad : PreloadedPad
        The nominal pad.
    linear_stiffness, linear_damping, factors
        See `WholePad`.
    step_size : float
        Of the step [s]; 0 for slow motion.
    memory : PadMemory, optional
        What pads remember at the beginning of the step.
    """

    pad: PreloadedPad
    step_size: float = 0.0
    memory: PadMemory | None = None

    def during(self, step_size: float, memory: PadMemory) -> ViscoelasticPads:
        """Return the law over a step; see `ComponentLaw.during`."""
        copies = PadMemory(*(values.copy() for values in memory))
        return replace(self, step_size=step_size, memory=copies)

    def remembered(
        self, deformation: FloatArray, rate: FloatArray, support: IntArray
    ) -> tuple[FloatArray, ...]:
        """Branch forces [N] and compressions [m]; see `ComponentLaw.remembered`."""
        compression = self._compression(deformation, support)
        if self.memory is None:
            _, c1, _, _ = self.pad.branch(self.pad.static(compression).load)
            return self.factors.pad_damping[support] * c1 * rate, compression
        return self._branch(self.memory, compression, support).force, compression

    def _compression(self, deformation: FloatArray, support: IntArray) -> FloatArray:
        loose = self.factors.fastened[support] == 0.0
        return np.where(loose & ~(deformation > 0.0), 0.0, deformation)

    def total(
        self, deformation: FloatArray, rate: FloatArray, support: IntArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Whole force and its derivatives; see `WholePad.total`."""
        factors = self.factors
        loose = factors.fastened[support] == 0.0
        x = self._compression(deformation, support)
        load, tangent, _ = self.pad.static(x)
        spring = factors.pad_stiffness[support]
        if self.memory is None:
            _, c1, _, _ = self.pad.branch(load)
            by_rate = factors.pad_damping[support] * c1
            branch = _Branch(by_rate * rate, np.zeros_like(x))
        else:
            by_rate = np.zeros_like(x)
            branch = self._branch(self.memory, x, support)
        total = spring * load + branch.force
        gone = loose & ((total < 0.0) | ~(deformation > 0.0))
        return (
            np.where(gone, 0.0, total),
            np.where(gone, 0.0, spring * tangent + branch.stiffness),
            np.where(gone, 0.0, by_rate),
        )

    def _branch(self, memory: PadMemory, x: FloatArray, support: IntArray) -> _Branch:
        """Branch at the end of the step."""
        known = memory.known[support] != 0.0
        first = np.where(known, memory.compression[support], x)
        static = self.pad.static(0.5 * (first + x))
        k1, c1, k1_by_load, c1_by_load = self.pad.branch(static.load)
        spring, dashpot = self.factors.pad_stiffness[support], self.factors.pad_damping[support]
        there = (spring * k1 > 0.0) & (dashpot > 0.0)
        k1, c1 = np.where(there, spring * k1, 0.0), np.where(there, dashpot * c1, 1.0)
        by_middle = 0.5 * static.tangent
        k1_slope = np.where(there, spring * k1_by_load, 0.0) * by_middle
        c1_slope = np.where(there, dashpot * c1_by_load, 0.0) * by_middle
        z = self.step_size * k1 / c1
        z_slope = self.step_size * (k1_slope * c1 - k1 * c1_slope) / (c1 * c1)
        small = z < SMALL
        safe = np.where(small, 1.0, z)
        decay = np.exp(-z)
        phi = np.where(small, 1.0 - z * (0.5 - z / 6.0), -np.expm1(-z) / safe)
        phi_slope = np.where(small, z / 3.0 - 0.5, (decay - phi) / safe)
        move, start = x - first, memory.branch_force[support]
        force = np.where(known & there, decay * start + k1 * phi * move, 0.0)
        stiffness = (
            k1 * phi - decay * z_slope * start + (k1_slope * phi + k1 * phi_slope * z_slope) * move
        )
        return _Branch(force, np.where(known & there, stiffness, 0.0))
