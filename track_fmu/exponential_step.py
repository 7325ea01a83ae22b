"""Exact step of the modal equations under a linearly varying load.

``q' = lambda q + Q0 + (Q1 - Q0) s / h`` has the solution ``q(h) = decay q(0) + start Q0 + end Q1``,
whatever the step size ``h``.
"""

from __future__ import annotations

import math
from collections import OrderedDict
from dataclasses import dataclass

import numpy as np

from .eigensolver import ComplexArray

REMEMBERED_STEP_SIZES = 64
SERIES_LIMIT = 0.2  # below it the closed forms lose digits to cancellation
SERIES_TERMS = 12  # 0.2^12 / 14! is below rounding


@dataclass(frozen=True, slots=True)
class ExponentialStep:
    """Coefficients of one step size.

    Attributes
    ----------
    decay, start, end : (S,) complex array
        Factors of the modal state [-] and of the load at both ends of the step [s].
    """

    decay: ComplexArray
    start: ComplexArray
    end: ComplexArray


def exponential_step(eigenvalues: ComplexArray, step_size: float) -> ExponentialStep:
    """Coefficients of the exact step for eigenvalues ``lambda``, shape (S,), and ``h`` [s]."""
    z = eigenvalues * step_size
    decay = np.exp(z)
    small = np.abs(z) < SERIES_LIMIT
    safe = np.where(small, 1.0, z)
    phi1 = np.where(small, _series(z, 1), (decay - 1.0) / safe)
    phi2 = np.where(small, _series(z, 2), (phi1 - 1.0) / safe)
    start: ComplexArray = np.multiply(step_size, phi1 - phi2, dtype=np.complex128)
    end: ComplexArray = np.multiply(step_size, phi2, dtype=np.complex128)
    return ExponentialStep(decay, start, end)


class ExponentialSteps:
    """Coefficients by step size; those used last are remembered.

    Parameters
    ----------
    eigenvalues : (S,) complex array
        ``lambda`` [1/s].
    """

    def __init__(self, eigenvalues: ComplexArray) -> None:
        self._eigenvalues = eigenvalues
        self._known: OrderedDict[float, ExponentialStep] = OrderedDict()

    def of(self, step_size: float) -> ExponentialStep:
        """Coefficients of a step size [s]."""
        known = self._known
        if step_size in known:
            known.move_to_end(step_size)
        else:
            known[step_size] = exponential_step(self._eigenvalues, step_size)
            if len(known) > REMEMBERED_STEP_SIZES:
                known.popitem(last=False)
        return known[step_size]


def _series(z: ComplexArray, order: int) -> ComplexArray:
    """Taylor series of ``phi_k(z) = sum_j z^j / (j + k)!``, nested."""
    total = np.ones_like(z)
    for j in range(SERIES_TERMS, 0, -1):
        total = 1.0 + total * z / (j + order)
    return total / math.factorial(order)
