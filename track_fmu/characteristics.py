"""Load over displacement of a component at rest, less its linear spring, as smooth curves.

Beyond the points that a curve is made for it goes on along its tangent.
"""

from __future__ import annotations

import math
from typing import NamedTuple, Protocol

import numpy as np

from .beam_element import FloatArray

POLE_SHARE = 0.9
"""Where the law of Eq. (26) is left for its tangent, as a part of the displacement of its pole."""


class Jet(NamedTuple):
    """Load [N] and its first and second derivative by displacement [N/m], [N/m2]."""

    load: FloatArray
    tangent: FloatArray
    curvature: FloatArray


class Characteristic(Protocol):
    """Load less that of the linear spring, over any displacement."""

    def jet(self, displacement: FloatArray) -> Jet:
        """Load and derivatives at displacements [m], shape (c,) each."""
        ...


class LinearCharacteristic:
    """Nothing beside the linear spring."""

    def jet(self, displacement: FloatArray) -> Jet:
        """See `Characteristic.jet`."""
        nothing = np.zeros_like(displacement)
        return Jet(nothing, nothing, nothing)


class PolynomialCharacteristic:
    """``alpha x^2 + beta x^3 + delta x^4`` for ``x > 0``, Eq. (27), and nothing below.

    Parameters
    ----------
    alpha, beta, delta : float
        Coefficients [N/m2], [N/m3], [N/m4].
    """

    def __init__(self, *, alpha: float, beta: float, delta: float) -> None:
        for name, value in (("alpha", alpha), ("beta", beta), ("delta", delta)):
            if not math.isfinite(value):
                raise ValueError(f"ballast: {name} = {value!r} must be a finite number")
        self._alpha, self._beta, self._delta = alpha, beta, delta

    def jet(self, displacement: FloatArray) -> Jet:
        """See `Characteristic.jet`."""
        x = np.maximum(displacement, 0.0)
        a, b, d = self._alpha, self._beta, self._delta
        curvature = 2.0 * a + x * (6.0 * b + x * 12.0 * d)
        return Jet(
            x * x * (a + x * (b + x * d)),
            x * (2.0 * a + x * (3.0 * b + x * 4.0 * d)),
            np.where(displacement > 0.0, curvature, 0.0),
        )


class HyperbolicCharacteristic:
    """``k x / (1 - slope x)`` for ``x > 0``: a secant stiffness ``k + slope F``, Eq. (26).

    Its pole at ``1 / slope`` is never met: from `POLE_SHARE` of the way on it is its tangent.

    Parameters
    ----------
    stiffness : float
        Of the unloaded component, ``k`` [N/m].
    slope : float
        Of the secant stiffness over the load [1/m], above 0.
    """

    def __init__(self, *, stiffness: float, slope: float) -> None:
        if not (math.isfinite(slope) and slope > 0.0):
            raise ValueError(
                f"ballast: slope = {slope!r} 1/m must be a finite number above 0; 2e3 is measured"
            )
        self._stiffness, self._slope = stiffness, slope

    def jet(self, displacement: FloatArray) -> Jet:
        """See `Characteristic.jet`."""
        k, slope = self._stiffness, self._slope
        limit = POLE_SHARE / slope
        x = np.minimum(np.maximum(displacement, 0.0), limit)
        beyond = np.maximum(displacement, 0.0) - x
        left = 1.0 - slope * x
        tangent = k / (left * left) - k
        curvature = 2.0 * k * slope / (left * left * left)
        inside = (displacement > 0.0) & (displacement < limit)
        return Jet(
            k * slope * x * x / left + tangent * beyond,
            tangent,
            np.where(inside, curvature, 0.0),
        )


class TableCharacteristic:
    """Monotone cubic (PCHIP) through points, tangents beyond; less ``stiffness x``.

    Parameters
    ----------
    displacement, load : (n,) float array
        At least 3 points [m], [N], both increasing, the origin among them.
    stiffness : float
        Of the linear spring [N/m].
    """

    def __init__(self, displacement: FloatArray, load: FloatArray, *, stiffness: float) -> None:
        check_increasing("displacement", displacement, "m")
        check_increasing("load", load, "N")
        at_origin = displacement == 0.0
        if not (at_origin.any() and load[at_origin][0] == 0.0):
            raise ValueError("load over displacement: the point 0 m, 0 N must be in the table")
        from scipy.interpolate import PchipInterpolator  # noqa: PLC0415 - takes long to import

        self._curve = PchipInterpolator(displacement, load)
        self._ends = float(displacement[0]), float(displacement[-1])
        self._stiffness = stiffness

    def jet(self, displacement: FloatArray) -> Jet:
        """See `Characteristic.jet`."""
        x = np.clip(displacement, *self._ends)
        tangent = self._curve(x, 1)
        inside = (displacement > self._ends[0]) & (displacement < self._ends[1])
        load = self._curve(x) + tangent * (displacement - x) - self._stiffness * displacement
        return Jet(load, tangent - self._stiffness, np.where(inside, self._curve(x, 2), 0.0))


def check_increasing(name: str, values: FloatArray, unit: str) -> None:
    """Refuse fewer than 3 numbers, or some that do not increase.

    Raises
    ------
    ValueError
        With the first place where they do not.
    """
    if len(values) < 3:
        raise ValueError(f"{name}: {len(values)} points; at least 3 are needed")
    wrong = np.flatnonzero(~(np.diff(values) > 0.0))
    if len(wrong):
        at = int(wrong[0])
        raise ValueError(
            f"{name} goes from {values[at]:g} to {values[at + 1]:g} {unit} at point {at + 2}; it "
            "must increase from point to point"
        )
