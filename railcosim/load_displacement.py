"""Ballast that stiffens under load: the measured law, its polynomial, its damping."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from track_fmu.ballast import secant_displacement

from .errors import InputError

if TYPE_CHECKING:
    from track_fmu.beam_element import FloatArray

SLOPE = 2e3
"""Rise of the secant stiffness over the load, Eq. (26) [1/m]."""

LARGEST_LOAD = 60e3
"""Load on a rail seat up to which the polynomial is fitted if nothing is said [N]."""

LOADS = 10
"""Equidistant loads at which it is fitted."""

MOST_LOADS = 10_000

HEAVIEST = 1e7
"""Bound of the loads: beyond them is only a slip of the keyboard [N]."""

STEEPEST = 1e9
"""The same of the slope of the secant stiffness [1/m]."""

SOFTEST, STIFFEST = 1.0, 1e15
"""The same of the unloaded ballast [N/m]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SecantLaw:
    """Ballast whose secant stiffness ``F / x = slope F + stiffness`` rises with the load, Eq. (26).

    Attributes
    ----------
    slope : float
        Rise of the secant stiffness over the load [1/m]; 0 is a linear ballast.
    stiffness : float
        Secant stiffness of the unloaded ballast under a rail seat [N/m].

    Raises
    ------
    InputError
        For a slope below zero, or one or a stiffness that no ballast has.
    """

    slope: float = SLOPE
    stiffness: float = 30e6

    def __post_init__(self) -> None:
        if not 0.0 <= self.slope <= STEEPEST:
            raise InputError(
                f"the slope of the secant stiffness is {self.slope:g} 1/m but must be from 0 to "
                f"{STEEPEST:g} 1/m: ballast that softens under load has no such law"
            )
        if not SOFTEST <= self.stiffness <= STIFFEST:
            raise InputError(
                f"the stiffness of the unloaded ballast is {self.stiffness:g} N/m but must be from "
                f"{SOFTEST:g} to {STIFFEST:g} N/m"
            )

    def displacement(self, force: FloatArray) -> FloatArray:
        """Sleeper displacement [m] under loads of at least 0 [N]."""
        return secant_displacement(force, slope=self.slope, stiffness=self.stiffness)

    def force(self, displacement: FloatArray) -> FloatArray:
        """Load [N] at sleeper displacements from 0 to below ``1 / slope`` [m], the inverse."""
        return np.asarray(self.stiffness * displacement / (1.0 - self.slope * displacement))


@dataclass(frozen=True, slots=True, kw_only=True)
class Polynomial:
    """Force increment ``alpha x^2 + beta x^3 + delta x^4`` over a linear ballast, Eq. (27).

    Attributes
    ----------
    alpha, beta, delta : float
        Coefficients [N/m2], [N/m3], [N/m4].
    stiffness : float
        Linear ballast [N/m].
    """

    alpha: float
    beta: float
    delta: float
    stiffness: float

    def force(self, displacement: FloatArray) -> FloatArray:
        """Whole load [N] at sleeper displacements of at least 0 [m]."""
        x = displacement
        return np.asarray(
            x * (self.stiffness + x * (self.alpha + x * (self.beta + x * self.delta)))
        )

    def least_tangent(self, largest: float) -> float:
        """Smallest tangent stiffness [N/m] between displacements 0 and ``largest`` [m]."""
        tangent = np.polynomial.Polynomial(
            [self.stiffness, 2.0 * self.alpha, 3.0 * self.beta, 4.0 * self.delta]
        )
        turns = tangent.deriv().roots()
        inside = turns.real[(np.abs(turns.imag) == 0.0) & (turns.real > 0.0)]
        places = np.array([0.0, largest, *inside[inside < largest]])
        return float(np.min(tangent(places)))


def equidistant_loads(largest: float = LARGEST_LOAD, count: int = LOADS) -> FloatArray:
    """Loads from ``largest / count`` to ``largest`` [N].

    Raises
    ------
    InputError
        For fewer loads than the polynomial has coefficients, or a largest load outside its bounds.
    """
    if not 0.0 < largest <= HEAVIEST:
        raise InputError(
            f"the largest load is {largest:g} N but must be above 0 N and at most {HEAVIEST:g} N"
        )
    if not 3 <= count <= MOST_LOADS:
        raise InputError(
            f"{count} loads are asked for but the polynomial has 3 coefficients: choose 3 to "
            f"{MOST_LOADS}"
        )
    return np.asarray(largest * np.arange(1, count + 1) / count)


def fit_polynomial(law: SecantLaw, loads: FloatArray) -> Polynomial:
    """Fit Eq. (27) to Eq. (26) by least squares of the force at the displacements of given loads.

    The linear stiffness is that of the law; with slope 0 the coefficients vanish.

    Parameters
    ----------
    law : SecantLaw
        What is mimicked.
    loads : (n,) float array
        At least 3 different ones above 0 [N].
    """
    displacement = law.displacement(loads)
    scale = float(displacement[-1])
    x = displacement / scale
    increment = loads - law.stiffness * displacement
    powers = np.stack([x**2, x**3, x**4], axis=1)
    alpha, beta, delta = np.linalg.lstsq(powers, increment, rcond=None)[0]
    return Polynomial(
        alpha=float(alpha) / scale**2,
        beta=float(beta) / scale**3,
        delta=float(delta) / scale**4,
        stiffness=law.stiffness,
    )


def loss_factor(*, energy: float, stiffness: float, displacement: float) -> float:
    """Loss factor of a hysteresis loop, Eq. (1).

    Parameters
    ----------
    energy : float
        Dissipated in a cycle, the area of the loop [J].
    stiffness : float
        Secant stiffness [N/m].
    displacement : float
        Largest displacement from the middle of the loop [m].

    Returns
    -------
    float
        ``E / (pi k x^2)`` [-].
    """
    return energy / (math.pi * stiffness * displacement**2)


def viscous_loss_factor(*, frequency: float, damping: float, stiffness: float) -> float:
    """Loss factor ``2 pi f c / k`` of a spring and a viscous damper at ``f`` [Hz], Eq. (28)."""
    return 2.0 * math.pi * frequency * damping / stiffness
