"""The state-dependent ballast fitted to measured secant stiffness."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import InputError
from ..load_displacement import LOADS, SecantLaw, equidistant_loads, fit_polynomial
from .estimate import Estimate, covariance, half_width, rounded

if TYPE_CHECKING:
    from track_fmu.beam_element import FloatArray

    from ..load_displacement import Polynomial
    from ..scenario import Scenario
    from ..secant_data import SecantData

LEAST_POINTS = 5
"""Measured points without which there is no telling how far they scatter."""

LEAST_SPAN = 1.5
"""Smallest ratio of the largest to the smallest load that shows how stiffness depends on it."""

COEFFICIENTS = {"alpha": "N/m2", "beta": "N/m3", "delta": "N/m4"}
"""Coefficients of Eq. (27) with their units."""

STEP = 1e-4
"""Relative step of the derivatives of the coefficients by the law."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TunedBallast:
    """A scenario whose ballast has the measured secant stiffness.

    Attributes
    ----------
    scenario : Scenario
        The one that was given, with the fitted ballast.
    law : SecantLaw
        Straight line through the measured secant stiffness, Eq. (26).
    polynomial : Polynomial
        Eq. (27) fitted to the line.
    estimates : tuple of Estimate
        Coefficients of the polynomial, and the stiffness of the unloaded ballast if fitted.
    slope : Estimate
        Of the line.
    points : int
        Measured points.
    scatter : float
        Root mean square distance of the secant stiffness from the line [N/m].
    polynomial_deviation : float
        Largest distance of the polynomial from the line's load at the fitted loads [N].
    largest_load : float
        Up to which it was fitted [N].
    """

    scenario: Scenario
    law: SecantLaw
    polynomial: Polynomial
    estimates: tuple[Estimate, ...]
    slope: Estimate
    points: int
    scatter: float
    polynomial_deviation: float
    largest_load: float


def tune_to_secant_stiffness(
    scenario: Scenario,
    data: SecantData,
    *,
    fit_stiffness: bool = False,
    largest_load: float | None = None,
    loads: int = LOADS,
) -> TunedBallast:
    """Fit a straight line to the secant stiffness, and the polynomial to the line.

    The line, Eq. (26), takes the scatter out; the polynomial, Eq. (27), is fitted to its
    load-displacement curve at equidistant loads, so it depends on the measurements by the line
    alone.

    Parameters
    ----------
    scenario : Scenario
        Gives the stiffness of the unloaded ballast where it is not fitted.
    data : SecantData
        Measured points.
    fit_stiffness : bool
        Whether the line's stiffness at no load becomes that of the unloaded ballast.
    largest_load : float, optional
        Up to which the polynomial is fitted [N]; the largest measured one without.
    loads : int
        Loads at which it is fitted.

    Raises
    ------
    InputError
        For data that do not show how the stiffness depends on the load.
    """
    _check_points(data)
    line, spread, residual = _fit_line(
        data, None if fit_stiffness else scenario.track.ballast_stiffness
    )
    freedom = len(data.force) - len(spread)
    width = half_width(spread[0, 0], freedom)
    slope = Estimate(
        name="slope", unit="1/m", value=line[0], low=line[0] - width, high=line[0] + width
    )
    if slope.low <= 0.0:
        raise InputError(
            f"the measured secant stiffness does not clearly rise with the load: its slope is "
            f"{slope.value:.3g} 1/m between {slope.low:.3g} and {slope.high:.3g}; measure over "
            "more loads, or use track.ballast=linear"
        )
    largest = float(data.force.max()) if largest_load is None else largest_load
    at = equidistant_loads(largest, loads)
    law = SecantLaw(slope=line[0], stiffness=line[1])
    polynomial = fit_polynomial(law, at)
    if polynomial.least_tangent(float(law.displacement(at)[-1])) <= 0.0:
        raise InputError(
            f"the polynomial fitted up to {largest:g} N would soften under load, since the line "
            f"rises to {1.0 + line[0] * largest / line[1]:.3g} times the stiffness of the unloaded "
            "ballast: choose a smaller --largest-load"
        )
    estimates = _estimates(line, spread, at, freedom=freedom)
    best: dict[str, Any] = {item.name: item.value for item in estimates}
    return TunedBallast(
        scenario=replace(
            scenario, track=replace(scenario.track, ballast="state_dependent", **best)
        ),
        law=law,
        polynomial=polynomial,
        estimates=estimates,
        slope=slope,
        points=len(data.force),
        scatter=float(np.sqrt(np.mean(residual**2))),
        polynomial_deviation=float(np.max(np.abs(polynomial.force(law.displacement(at)) - at))),
        largest_load=largest,
    )


def _check_points(data: SecantData) -> None:
    points = len(data.force)
    if points < LEAST_POINTS:
        raise InputError(
            f"{points} measured points are too few to fit the ballast: give {LEAST_POINTS} or more"
        )
    span = float(data.force.max() / data.force.min())
    if span < LEAST_SPAN:
        raise InputError(
            f"the largest measured load is {span:.3g} times the smallest but must be at least "
            f"{LEAST_SPAN:g} times it to show how the stiffness depends on the load: measure over "
            "more loads"
        )


def _fit_line(
    data: SecantData, stiffness: float | None
) -> tuple[tuple[float, float], FloatArray, FloatArray]:
    """Slope and stiffness of the line, their covariance (of the fitted ones), what is left."""
    if stiffness is None:
        columns, wanted = [data.force, np.ones_like(data.force)], data.stiffness
    else:
        columns, wanted = [data.force], data.stiffness - stiffness
    matrix = np.stack(columns, axis=1)
    scale = np.linalg.norm(matrix, axis=0)
    found = np.linalg.lstsq(matrix / scale, wanted, rcond=None)[0]
    residual = wanted - (matrix / scale) @ found
    spread = covariance(matrix / scale, residual) / np.outer(scale, scale)
    found = found / scale
    line = float(found[0]), float(found[1]) if stiffness is None else stiffness
    return line, spread, residual


def _estimates(
    line: tuple[float, float], spread: FloatArray, loads: FloatArray, *, freedom: int
) -> tuple[Estimate, ...]:
    """Coefficients with the intervals that follow from those of the line, to first order."""
    fitted = len(spread)

    def coefficients(line: FloatArray) -> FloatArray:
        fit = fit_polynomial(SecantLaw(slope=float(line[0]), stiffness=float(line[1])), loads)
        return np.array([getattr(fit, name) for name in COEFFICIENTS])

    centre = np.array(line)
    gradient = np.empty((len(COEFFICIENTS), fitted))
    for k in range(fitted):
        step = np.zeros(2)
        step[k] = STEP * centre[k]
        gradient[:, k] = (coefficients(centre + step) - coefficients(centre - step)) / (2 * step[k])
    variances = np.diag(gradient @ spread @ gradient.T)
    names = [(f"ballast_{name}", unit) for name, unit in COEFFICIENTS.items()]
    values = list(zip(names, coefficients(centre), variances, strict=True))
    if fitted == len(line):
        values.append((("ballast_stiffness", "N/m"), line[1], spread[1, 1]))
    estimates = []
    for (name, unit), value, variance in values:
        width = half_width(float(variance), freedom)
        estimates.append(
            Estimate(
                name=name,
                unit=unit,
                value=rounded(float(value)),
                low=float(value) - width,
                high=float(value) + width,
            )
        )
    return tuple(estimates)
