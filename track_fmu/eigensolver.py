"""Complex eigenvalues and modes of a lightly or heavily damped chain-like structure.

``(lambda^2 M + lambda C + K) rho = 0`` with banded symmetric matrices is solved in three steps:

1. The lowest undamped modes, together with the static response to unit forces in every damper,
   span a subspace that holds the damped modes to about 1e-6 (see `modal_subspace`).
2. The damped problem is solved in that subspace with dense linear algebra.
3. Every mode is refined by inverse iteration with the Rayleigh functional on the full banded
   matrices until its eigenvalue stands still (see `banded_polynomial`).

A set in which two refined modes coincide would be incomplete; that is checked and refused.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import scipy.linalg as la
from numpy.typing import NDArray

from .banded_polynomial import BandedPolynomial
from .modal_subspace import lowest_states, modal_subspace, modes_in

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
        subspace = modal_subspace(mass, stiffness, dampers, count=count)
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
    eigenvalues, modes = modes_in(mass, damping, stiffness, subspace)
    chosen = lowest_states(eigenvalues, mode_pairs)
    eigenvalues, modes = eigenvalues[chosen], modes[:, chosen]
    polynomial = BandedPolynomial(mass, damping, stiffness)
    for n in range(len(eigenvalues)):
        eigenvalues[n], modes[:, n] = _refine(polynomial, complex(eigenvalues[n]), modes[:, n])
    order = np.argsort(np.abs(eigenvalues), kind="stable")
    eigenvalues, modes = eigenvalues[order], modes[:, order]
    _normalise(eigenvalues, modes, mass, damping)
    _orthogonalise(eigenvalues, modes, mass, damping)
    return EigenPairs(eigenvalues=eigenvalues, modes=modes)


def _refine(
    polynomial: BandedPolynomial, eigenvalue: complex, mode: ComplexArray
) -> tuple[complex, ComplexArray]:
    """Inverse iteration with the Rayleigh functional until the eigenvalue stands still."""
    is_real, start = eigenvalue.imag == 0.0, eigenvalue
    if polynomial.backward_error(eigenvalue, mode) <= SETTLED:
        return eigenvalue, mode  # a sweep could only mix it with a mode that is very close
    for _ in range(MAX_SWEEPS):
        better = polynomial.iterate(eigenvalue, mode)
        if better is None:
            raise EigenvalueError(
                f"track: no mode found near the eigenvalue {eigenvalue:.6g} 1/s; two may "
                "coincide there: change the damping slightly"
            )
        mode = better.real.astype(np.complex128) if is_real else better
        previous, eigenvalue = eigenvalue, polynomial.rayleigh(mode, eigenvalue)
        if abs(eigenvalue - start) > REACH * abs(start):
            break  # it went to another mode
        if abs(eigenvalue - previous) <= EIGENVALUE_TOLERANCE * abs(eigenvalue):
            return eigenvalue, mode
    raise EigenvalueError(
        f"track: the mode near {eigenvalue:.6g} 1/s did not converge in {MAX_SWEEPS} sweeps; "
        "two eigenvalues may coincide: change the damping slightly"
    )


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
