"""Load over displacement of ballast and pads at rest, with two derivatives.

Beyond the points that a curve is made for it goes on along its tangent.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np
from scipy.interpolate import PchipInterpolator

from fmu_src.python.track_laws import CHARACTERISTIC
from track_fmu.characteristics import POLE_SHARE

from ..input_tables import read_as

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from scipy.interpolate import CubicHermiteSpline

    from ..track_section import Track

    Array = NDArray[np.float64]


class Jet(NamedTuple):
    """Load [N] with its first and second derivative [N/m], [N/m2]; one shape all."""

    load: Array
    slope: Array
    curvature: Array


class Curve(Protocol):
    """Whole load of a component at rest."""

    def jet(self, displacement: Array) -> Jet:
        """Return load and derivatives at displacements [m] of any shape."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class PowerCurve:
    """``k x``, and for ``x > 0`` also ``alpha x^2 + beta x^3 + delta x^4``, Eq. (27).

    Attributes
    ----------
    stiffness, alpha, beta, delta : float
        Coefficients from the first power on [N/m], [N/m2], [N/m3], [N/m4].
    """

    stiffness: float
    alpha: float = 0.0
    beta: float = 0.0
    delta: float = 0.0

    def jet(self, displacement: Array) -> Jet:
        """See `Curve.jet`."""
        x, k = np.maximum(displacement, 0.0), self.stiffness
        a, b, d = self.alpha, self.beta, self.delta
        return Jet(
            k * displacement + x**2 * (a + x * (b + x * d)),
            k + x * (2.0 * a + x * (3.0 * b + x * 4.0 * d)),
            (displacement > 0.0) * (2.0 * a + x * (6.0 * b + x * 12.0 * d)),
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class SecantCurve:
    """``F = (k + slope F) x`` for ``x > 0``, Eq. (26), and ``k x`` below.

    It is left for its tangent before the pole at ``1 / slope``, where the FMUs leave it.

    Attributes
    ----------
    stiffness, slope : float
        Secant stiffness without load [N/m], and its rise over the load [1/m].
    """

    stiffness: float
    slope: float

    def jet(self, displacement: Array) -> Jet:
        """See `Curve.jet`, from ``F' = k / (1 - slope x)^2``."""
        end = POLE_SHARE / self.slope
        x = np.clip(displacement, 0.0, end)
        left = 1.0 / (1.0 - self.slope * x)
        slope = self.stiffness * left**2
        inside = (displacement > 0.0) & (displacement < end)
        return Jet(
            self.stiffness * x * left + slope * (displacement - x),
            slope,
            np.where(inside, 2.0 * self.slope * slope * left, 0.0),
        )


class PiecewiseCurve:
    """Cubic pieces between points.

    Parameters
    ----------
    pieces : CubicHermiteSpline
        Of one variable.
    """

    __slots__ = ("_ends", "_pieces")

    def __init__(self, pieces: CubicHermiteSpline) -> None:
        self._pieces = pieces
        self._ends = float(pieces.x[0]), float(pieces.x[-1])

    def jet(self, displacement: Array) -> Jet:
        """See `Curve.jet`."""
        x = np.clip(displacement, *self._ends)
        slope = self._pieces(x, 1)
        return Jet(
            self._pieces(x) + slope * (displacement - x),
            slope,
            np.where(x == displacement, self._pieces(x, 2), 0.0),
        )


def point_curve(displacement: Array, load: Array) -> PiecewiseCurve:
    """Return the smooth monotone curve through points [m], [N], as the FMUs draw it."""
    return PiecewiseCurve(PchipInterpolator(displacement, load))


def ballast_curve(track: Track) -> Curve:
    """Return the whole load of a scenario's nominal ballast.

    Raises
    ------
    InputError
        For a file that cannot be read.
    """
    stiffness = track.ballast_stiffness
    if track.ballast == "linear":
        return PowerCurve(stiffness=stiffness)
    if track.ballast == "state_dependent":
        return PowerCurve(
            stiffness=stiffness,
            alpha=track.ballast_alpha,
            beta=track.ballast_beta,
            delta=track.ballast_delta,
        )
    if track.ballast == "hyperbolic":
        return SecantCurve(stiffness=stiffness, slope=track.ballast_slope)
    return read_as(point_curve, track.ballast, CHARACTERISTIC)
