"""Complex eigenvalues and modes of a lightly or heavily damped chain-like structure.

``(lambda^2 M + lambda C + K) rho = 0`` with banded symmetric matrices is solved in three steps:

1. The lowest undamped modes, together with the static response to unit forces in every damper,
   span a subspace that holds the damped modes to about 1e-6 (a damped mode is driven by its
   damper forces alone, and the static responses carry what the cut-off modes would add).
2. The damped problem is solved in that subspace with dense linear algebra.
3. Every mode is refined by inverse iteration with the Rayleigh functional on the full banded
   matrices until its eigenvalue stands still, which costs one banded factorisation per sweep.

A set in which two refined modes coincide would be incomplete; that is checked and refused.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import scipy.linalg as la
from numpy.typing import NDArray
from scipy.linalg.lapack import zgbsv

from .assembly import half_bandwidth, to_banded

if TYPE_CHECKING:
    import scipy.sparse as sp

    from .beam_element import FloatArray

ComplexArray = NDArray[np.complex128]

EIGENVALUE_TOLERANCE = 1e-12  # relative; set by the condition of the element matrices
SETTLED = 1e-11  # backward error of an eigenpair of the subspace that is good enough as it is
DEFECTIVE = 1e-10  # a_n over its damping term, below which a mode is critically damped
MIXED = 1e-9  # A-product of two modes above which they are made orthogonal
CLUSTER = 1e-7  # relative distance of eigenvalues whose modes may be mixed
ORTHOGONALITY = 1e-3  # largest A-product of two modes in the end
MAX_SWEEPS = 8
REACH = 1e-3  # relative; how far an eigenvalue of the subspace may be from that of its mode
SPARE_MODES = 20  # undamped modes beyond the wanted ones, for the last damped ones to settle
REAL_TOLERANCE = 1e-9  # |Im| / |lambda| below which an eigenvalue of the subspace is real


class EigenvalueError(RuntimeError):
    """The requested modes could not be determined reliably."""


@dataclass(frozen=True, slots=True, kw_only=True)
class EigenPairs:
    """Eigenvalues with non-negative imaginary part in ascending modulus, and their modes.

    Attributes
    ----------
    eigenvalues : (S,) complex array
        ``i omega_n`` [1/s]; an overdamped pair contributes two real ones.
    modes : (N, S) complex array
        Normalised to ``a_n = 1`` of Eq. (11a).
    """

    eigenvalues: ComplexArray
    modes: ComplexArray


def solve_damped(
    mass: sp.csc_array,
    damping: sp.csc_array,
    stiffness: sp.csc_array,
    dampers: sp.csc_array,
    *,
    mode_pairs: int,
) -> EigenPairs:
    """Lowest eigenpairs of ``lambda^2 M + lambda C + K``.

    Parameters
    ----------
    mass, damping, stiffness : (N, N) sparse array
        Symmetric and banded; M and K positive definite.
    dampers : (N, d) sparse array
        Directions that span the damping forces, at least those of the wanted modes.
    mode_pairs : int
        Complex-conjugate pairs to find; two overdamped real eigenvalues count as one pair.

    Raises
    ------
    ValueError
        If ``mode_pairs`` is outside 1..N.
    EigenvalueError
        If a mode does not converge or two of them coincide.
    """
    size = mass.shape[0]
    if not 1 <= mode_pairs <= size:
        raise ValueError(
            f"track: mode_pairs = {mode_pairs} must lie between 1 and {size}, the number of "
            "degrees of freedom; use fewer pairs or more elements per bay"
        )
    spare = SPARE_MODES
    while True:  # a larger subspace is better; the largest one is the whole space
        count = min(size, mode_pairs + spare)
        subspace = _subspace(mass, stiffness, dampers, count=count)
        try:
            return _solve_in(subspace, mass, damping, stiffness, mode_pairs=mode_pairs)
        except EigenvalueError:
            if count == size:
                raise
            spare *= 4


def _solve_in(
    subspace: FloatArray,
    mass: sp.csc_array,
    damping: sp.csc_array,
    stiffness: sp.csc_array,
    *,
    mode_pairs: int,
) -> EigenPairs:
    """Lowest eigenpairs, from those of a subspace.

    Raises
    ------
    EigenvalueError
        If the subspace is too coarse for every mode to be refined without meeting another one.
    """
    eigenvalues, modes = _solve_reduced(mass, damping, stiffness, subspace)
    chosen = _select(eigenvalues, mode_pairs)
    eigenvalues, modes = eigenvalues[chosen], modes[:, chosen]
    polynomial = _BandedPolynomial(mass, damping, stiffness)
    for n in range(len(eigenvalues)):
        eigenvalues[n], modes[:, n] = polynomial.refine(complex(eigenvalues[n]), modes[:, n])
    order = np.argsort(np.abs(eigenvalues), kind="stable")
    eigenvalues, modes = eigenvalues[order], modes[:, order]
    _normalise(eigenvalues, modes, mass, damping)
    _orthogonalise(eigenvalues, modes, mass, damping)
    return EigenPairs(eigenvalues=eigenvalues, modes=modes)


def _subspace(
    mass: sp.csc_array, stiffness: sp.csc_array, dampers: sp.csc_array, *, count: int
) -> FloatArray:
    """M-orthonormal basis of the lowest undamped modes and the damper forces' static response."""
    size = mass.shape[0]
    _, modes = la.eigh(stiffness.toarray(), mass.toarray(), subset_by_index=[0, count - 1])
    if count == size:
        return np.asarray(modes)
    static = la.solveh_banded(to_banded(stiffness), dampers.toarray(), lower=True)
    for _ in range(2):  # twice is enough for orthogonality to rounding
        static -= modes @ (modes.T @ (mass @ static))
    strength, directions = la.eigh(static.T @ (mass @ static))
    kept = strength > 1e-13 * strength[-1]
    added = static @ (directions[:, kept] / np.sqrt(strength[kept]))
    return np.hstack([modes, added])[:, :size]


def _solve_reduced(
    mass: sp.csc_array, damping: sp.csc_array, stiffness: sp.csc_array, subspace: FloatArray
) -> tuple[ComplexArray, ComplexArray]:
    """Eigenpairs of the damped problem projected on the subspace, upper half plane only."""
    m, c, k = (subspace.T @ (matrix @ subspace) for matrix in (mass, damping, stiffness))
    factor = la.cho_factor(m)
    count = len(m)
    state = np.zeros((2 * count, 2 * count))
    state[:count, count:] = np.eye(count)
    state[count:, :count] = -la.cho_solve(factor, k)
    state[count:, count:] = -la.cho_solve(factor, c)
    eigenvalues, vectors = (np.asarray(part, dtype=np.complex128) for part in la.eig(state))
    real = np.abs(eigenvalues.imag) <= REAL_TOLERANCE * np.abs(eigenvalues)
    eigenvalues[real] = eigenvalues[real].real
    upper = eigenvalues.imag >= 0.0
    eigenvalues, vectors = eigenvalues[upper], vectors[:count, upper]
    order = np.argsort(np.abs(eigenvalues), kind="stable")
    return eigenvalues[order], subspace @ vectors[:, order]


def _select(eigenvalues: ComplexArray, mode_pairs: int) -> slice:
    """Take the lowest states until ``2 * mode_pairs`` are reached; no complex pair is split."""
    states = np.cumsum(np.where(eigenvalues.imag == 0.0, 1, 2))
    return slice(0, int(np.searchsorted(states, 2 * mode_pairs, side="right")))


class _BandedPolynomial:
    """``T(lambda) = lambda^2 M + lambda C + K`` in band storage, and the refinement of a mode."""

    def __init__(self, mass: sp.csc_array, damping: sp.csc_array, stiffness: sp.csc_array) -> None:
        self.matrices = (mass, damping, stiffness)
        self.width = half_bandwidth(*self.matrices)
        self.bands = tuple(_general_band(matrix, self.width) for matrix in self.matrices)

    def refine(self, eigenvalue: complex, mode: ComplexArray) -> tuple[complex, ComplexArray]:
        """Inverse iteration with the Rayleigh functional until the eigenvalue stands still."""
        mass, damping, _ = self.matrices
        is_real, start = eigenvalue.imag == 0.0, eigenvalue
        if self._backward_error(eigenvalue, mode) <= SETTLED:
            return eigenvalue, mode  # a sweep could only mix it with a mode that is very close
        for _ in range(MAX_SWEEPS):
            band = self.bands[2] + eigenvalue * (self.bands[1] + eigenvalue * self.bands[0])
            right = 2.0 * eigenvalue * (mass @ mode) + damping @ mode
            _, _, mode, info = zgbsv(self.width, self.width, band, right)
            largest = mode[np.argmax(np.abs(mode))]
            if info < 0 or not np.isfinite(largest) or largest == 0.0:
                raise EigenvalueError(
                    f"track: no mode found near the eigenvalue {eigenvalue:.6g} 1/s; two may "
                    "coincide there: change the damping slightly"
                )
            mode = mode / largest
            if is_real:
                mode = mode.real.astype(np.complex128)
            previous, eigenvalue = eigenvalue, self._rayleigh(mode, eigenvalue)
            if abs(eigenvalue - start) > REACH * abs(start):
                break  # it went to another mode
            if abs(eigenvalue - previous) <= EIGENVALUE_TOLERANCE * abs(eigenvalue):
                return eigenvalue, mode
        raise EigenvalueError(
            f"track: the mode near {eigenvalue:.6g} 1/s did not converge in {MAX_SWEEPS} sweeps; "
            "two eigenvalues may coincide: change the damping slightly"
        )

    def _backward_error(self, eigenvalue: complex, mode: ComplexArray) -> float:
        """Relative change of the matrices that would make this an exact eigenpair."""
        mass, damping, stiffness = (np.asarray(matrix @ mode) for matrix in self.matrices)
        terms = (eigenvalue**2 * mass, eigenvalue * damping, stiffness)
        scale = sum(float(np.linalg.norm(term)) for term in terms)
        return float(np.linalg.norm(sum(terms))) / scale

    def _rayleigh(self, mode: ComplexArray, near: complex) -> complex:
        """Root of ``mode^T T(lambda) mode = 0`` nearest to a given value."""
        a, b, c = (complex(np.dot(mode, np.asarray(matrix @ mode))) for matrix in self.matrices)
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


def _normalise(
    eigenvalues: ComplexArray, modes: ComplexArray, mass: sp.csc_array, damping: sp.csc_array
) -> None:
    """Scale the modes in place to ``a_n = 2 lambda rho^T M rho + rho^T C rho = 1``, Eq. (11a)."""
    mass_terms = np.sum(modes * np.asarray(mass @ modes), axis=0)
    damping_terms = np.sum(modes * np.asarray(damping @ modes), axis=0)
    norms = 2.0 * eigenvalues * mass_terms + damping_terms
    if np.any(np.abs(norms) <= DEFECTIVE * np.abs(damping_terms)):
        raise EigenvalueError(
            "track: a mode is critically damped and has no norm; change the damping slightly"
        )
    modes /= np.sqrt(norms)


def _orthogonalise(
    eigenvalues: ComplexArray, modes: ComplexArray, mass: sp.csc_array, damping: sp.csc_array
) -> None:
    """Make modes of nearly equal eigenvalues A-orthogonal in place, as Eq. (11a) demands.

    Where eigenvalues agree to rounding their modes are found up to a mixture only; the symmetric
    choice changes them least. A set in which two modes coincide would be incomplete.

    Raises
    ------
    EigenvalueError
        If two modes coincide.
    """
    products = _a_products(eigenvalues, modes, mass, damping)
    related = np.abs(products - np.eye(len(products))) > MIXED
    for first in np.flatnonzero(related.any(axis=1)):
        cluster = np.flatnonzero(related[first])
        cluster = np.union1d(cluster, [first])
        block = products[np.ix_(cluster, cluster)]
        spread = np.ptp(np.abs(eigenvalues[cluster])) / abs(eigenvalues[first])
        if cluster[0] == first and spread < CLUSTER and np.linalg.cond(block) < 1e3:
            modes[:, cluster] = modes[:, cluster] @ np.linalg.inv(la.sqrtm(block))
    products = _a_products(eigenvalues, modes, mass, damping)
    worst = float(np.max(np.abs(products - np.eye(len(products)))))
    if worst > ORTHOGONALITY:
        raise EigenvalueError(
            f"track: two of the {len(eigenvalues)} modes coincide (orthogonality {worst:.1e}, "
            f"limit {ORTHOGONALITY:g}); change the damping or the number of mode pairs slightly"
        )


def _a_products(
    eigenvalues: ComplexArray, modes: ComplexArray, mass: sp.csc_array, damping: sp.csc_array
) -> ComplexArray:
    """``P^T A P`` of Eq. (11a), shape (S, S)."""
    sums = eigenvalues[:, None] + eigenvalues[None, :]
    products: ComplexArray = modes.T @ np.asarray(damping @ modes)
    products += (modes.T @ np.asarray(mass @ modes)) * sums
    return products
