"""Three-parameter rail pad whose parameters depend on its preload: spring and Maxwell branch.

The stiffnesses and the damping are those of small motions about a preload, as a laboratory measures
them: a spring ``k0(P)`` in parallel with ``k1(P)`` and ``c1(P)`` in series. The load at rest has
``k0`` as its tangent, ``dP/dx = k0(P)``, from the preload of the clip on.
"""

from __future__ import annotations

import math

import numpy as np

from .assembly import IntArray
from .beam_element import FloatArray
from .characteristics import Jet, check_increasing

FLAT = 1e-9
"""Change of a stiffness between two rows, relative to it, below which it is none."""


class PreloadedPad:
    """Static curve and branch parameters of a pad over its compression beyond the clip's preload.

    Parameters
    ----------
    preload : (n,) float array
        At least 3 preloads, increasing [N].
    static_stiffness, branch_stiffness, branch_damping : (n,) float array
        ``k0`` > 0, ``k1`` >= 0 [N/m] and ``c1`` > 0 [N s/m]; straight lines between the rows,
        constant beyond them.
    clip_preload : float
        Of the pad under the unloaded rail [N], at least 0.

    Raises
    ------
    ValueError
        For values that no pad has.
    """

    def __init__(
        self,
        preload: FloatArray,
        static_stiffness: FloatArray,
        branch_stiffness: FloatArray,
        branch_damping: FloatArray,
        *,
        clip_preload: float,
    ) -> None:
        check_increasing("preload", preload, "N")
        _check_limit("static_stiffness", static_stiffness, "N/m", zero_is_fine=False)
        _check_limit("branch_stiffness", branch_stiffness, "N/m", zero_is_fine=True)
        _check_limit("branch_damping", branch_damping, "N.s/m", zero_is_fine=False)
        if not (math.isfinite(clip_preload) and clip_preload >= 0.0):
            raise ValueError(
                f"pad: clip_preload = {clip_preload!r} N must be a finite number, at least 0"
            )
        self._preload, self._clip = preload, clip_preload
        self._branch_stiffness, self._branch_damping = branch_stiffness, branch_damping
        self._stiffness = static_stiffness
        rise = np.diff(static_stiffness) / np.diff(preload)  # dk0/dP [1/m]
        flat = np.abs(np.diff(static_stiffness)) < FLAT * static_stiffness[:-1]
        self._rise = np.concatenate(([0.0], np.where(flat, 0.0, rise), [0.0]))
        # first and last piece lie before and behind the rows
        self._load = np.concatenate((preload[:1], preload))
        self._tangent = np.concatenate((static_stiffness[:1], static_stiffness))
        width = self._width(preload[1:] - preload[:-1], np.arange(1, len(preload)))
        place = np.concatenate(([0.0, 0.0], np.cumsum(width)))
        piece = int(np.searchsorted(preload, clip_preload, side="right"))
        to_clip = self._width(np.array([clip_preload - self._load[piece]]), np.array([piece]))
        self._place = place - (place[piece] + to_clip[0])  # compression at each piece's load

    def static(self, compression: FloatArray) -> Jet:
        """Load beyond the preload at rest, and its derivatives by the compression [m]."""
        piece = np.searchsorted(self._place[1:], compression, side="right")
        rise, tangent = self._rise[piece], self._tangent[piece]
        d = compression - self._place[piece]
        bent = rise != 0.0
        safe = np.where(bent, rise, 1.0)
        gain = np.where(bent, tangent * np.expm1(rise * d) / safe, tangent * d)
        stiffness = tangent + rise * gain
        return Jet(self._load[piece] - self._clip + gain, stiffness, rise * stiffness)

    def branch(self, load: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """``k1`` and ``c1`` at a load beyond the preload, and their derivatives by it, (c,)."""
        preload = load + self._clip
        k1 = np.interp(preload, self._preload, self._branch_stiffness)
        c1 = np.interp(preload, self._preload, self._branch_damping)
        piece = np.searchsorted(self._preload, preload, side="right")
        by_load = [
            np.concatenate(([0.0], np.diff(values) / np.diff(self._preload), [0.0]))[piece]
            for values in (self._branch_stiffness, self._branch_damping)
        ]
        return k1, c1, by_load[0], by_load[1]

    def _width(self, rise_of_load: FloatArray, piece: IntArray) -> FloatArray:
        """Compression in which the load rises by so much from the beginning of a piece."""
        slope, tangent = self._rise[piece], self._tangent[piece]
        safe = np.where(slope != 0.0, slope, 1.0)
        bent = np.log1p(np.where(slope != 0.0, slope * rise_of_load / tangent, 0.0)) / safe
        return np.where(slope != 0.0, bent, rise_of_load / tangent)


def _check_limit(name: str, values: FloatArray, unit: str, *, zero_is_fine: bool) -> None:
    wrong = np.flatnonzero(~(np.isfinite(values) & (values >= 0.0)))
    if not zero_is_fine:
        wrong = np.flatnonzero(~(np.isfinite(values) & (values > 0.0)))
    if len(wrong):
        limit = "at least 0" if zero_is_fine else "above 0"
        raise ValueError(
            f"pad: {name} is {values[wrong[0]]:g} {unit} in row {wrong[0] + 1}; it must be {limit}"
        )
