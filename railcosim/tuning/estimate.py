"""A fitted parameter with its confidence interval."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.special import stdtrit

if TYPE_CHECKING:
    from track_fmu.beam_element import FloatArray

CONFIDENCE = 0.95
"""Probability with which an interval covers the true value, if the model is right and the errors
are independent of each other, normal and equally large."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Estimate:
    """A fitted key of ``[track]`` in its SI unit.

    Attributes
    ----------
    name, unit : str
        The key and its unit.
    value, low, high : float
        Best value and its confidence interval.
    """

    name: str
    unit: str
    value: float
    low: float
    high: float

    def numbers(self) -> dict[str, Any]:
        """Return value, interval and unit."""
        return {key: item for key, item in asdict(self).items() if key != "name"}


def rounded(value: float) -> float:
    """Round to six digits, two more than any measurement has, so that files stay readable."""
    return float(f"{value:.6g}")


def covariance(jacobian: FloatArray, residual: FloatArray) -> FloatArray:
    """Covariance of least-squares parameters, from the scatter that is left.

    Parameters
    ----------
    jacobian : (m, n) float array
        Derivative of the residuals by the parameters, m > n.
    residual : (m,) float array
        At the optimum.

    Returns
    -------
    (n, n) float array
        ``s^2 (J^T J)^-1`` with ``s^2 = r^T r / (m - n)``; infinite where the data say nothing.
    """
    count, size = jacobian.shape
    variance = float(residual @ residual) / (count - size)
    _, singular, right = np.linalg.svd(jacobian, full_matrices=False)
    if singular[-1] <= singular[0] * count * np.finfo(float).eps:
        return np.full((size, size), np.inf)
    scaled = right / singular[:, None]
    return np.asarray(variance * scaled.T @ scaled)


def half_width(variance: float, degrees_of_freedom: int) -> float:
    """Half of a confidence interval, by Student's distribution."""
    return float(stdtrit(degrees_of_freedom, 0.5 + 0.5 * CONFIDENCE)) * float(np.sqrt(variance))
