"""The matrix polynomial of a damped structure whose matrices are symmetric and banded."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg.lapack import zgbsv

from .assembly import half_bandwidth

if TYPE_CHECKING:
    import scipy.sparse as sp

    from .eigensolver import ComplexArray


class BandedPolynomial:
    """``T(lambda) = lambda^2 M + lambda C + K`` in band storage.

    Parameters
    ----------
    mass, damping, stiffness : (N, N) sparse array
        M, C and K.
    """

    def __init__(self, mass: sp.csc_array, damping: sp.csc_array, stiffness: sp.csc_array) -> None:
        self._matrices = (mass, damping, stiffness)
        self._width = half_bandwidth(*self._matrices)
        self._bands = tuple(_general_band(matrix, self._width) for matrix in self._matrices)

    def iterate(self, eigenvalue: complex, mode: ComplexArray) -> ComplexArray | None:
        """One sweep of inverse iteration, which costs one banded factorisation.

        Parameters
        ----------
        eigenvalue : complex
            Approximation [1/s].
        mode : (N,) complex array
            Approximation of its mode.

        Returns
        -------
        (N,) complex array or None
            The mode with 1 as its largest component; None if there is none near the eigenvalue.
        """
        mass, damping, _ = self._matrices
        band = self._bands[2] + eigenvalue * (self._bands[1] + eigenvalue * self._bands[0])
        right = 2.0 * eigenvalue * (mass @ mode) + damping @ mode
        _, _, found, info = zgbsv(self._width, self._width, band, right)
        largest = found[np.argmax(np.abs(found))]
        if info < 0 or not np.isfinite(largest) or largest == 0.0:
            return None
        return np.asarray(found / largest)

    def backward_error(self, eigenvalue: complex, mode: ComplexArray) -> float:
        """Relative change of the matrices that would make this an exact eigenpair."""
        mass, damping, stiffness = (np.asarray(matrix @ mode) for matrix in self._matrices)
        terms = (eigenvalue**2 * mass, eigenvalue * damping, stiffness)
        scale = sum(float(np.linalg.norm(term)) for term in terms)
        return float(np.linalg.norm(sum(terms))) / scale

    def rayleigh(self, mode: ComplexArray, near: complex) -> complex:
        """Root of ``mode^T T(lambda) mode = 0`` nearest to a given value."""
        a, b, c = (complex(np.dot(mode, np.asarray(matrix @ mode))) for matrix in self._matrices)
        root = np.sqrt(complex(b * b - 4.0 * a * c))
        # the larger of -b +- root, and c over it: no cancellation
        large = -0.5 * (b + root) if abs(b + root) >= abs(b - root) else -0.5 * (b - root)
        return complex(min((large / a, c / large), key=lambda candidate: abs(candidate - near)))


def _general_band(matrix: sp.csc_array, width: int) -> ComplexArray:
    """Storage of a symmetric band matrix for LAPACK's gbsv, shape (3 * width + 1, N)."""
    size = matrix.shape[0]
    band = np.zeros((3 * width + 1, size), dtype=np.complex128, order="F")
    for k in range(-width, width + 1):
        diagonal = matrix.diagonal(k)
        band[2 * width - k, max(k, 0) : max(k, 0) + len(diagonal)] = diagonal
    return band
