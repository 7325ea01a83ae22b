"""A small subspace that holds the lowest damped modes of a structure, and the modes in it.

A damped mode is driven by its damper forces alone. The lowest undamped modes therefore hold it, up
to what the cut-off ones would add, which the static response to unit damper forces carries.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import scipy.linalg as la

from .assembly import to_banded

if TYPE_CHECKING:
    import scipy.sparse as sp

    from .beam_element import FloatArray
    from .eigensolver import ComplexArray

REAL_TOLERANCE = 1e-9  # |Im| / |lambda| below which an eigenvalue of the subspace is real


def modal_subspace(
    mass: sp.csc_array, stiffness: sp.csc_array, dampers: sp.csc_array, *, count: int
) -> FloatArray:
    """M-orthonormal basis of the lowest undamped modes and the damper forces' static response.

    Parameters
    ----------
    mass, stiffness : (N, N) sparse array
        Symmetric and banded, positive definite.
    dampers : (N, d) sparse array
        Directions that span the damping forces.
    count : int
        Number of undamped modes; with N of them they are the whole basis.

    Returns
    -------
    (N, s) array
        ``s <= count + d`` columns.
    """
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


def modes_in(
    mass: sp.csc_array, damping: sp.csc_array, stiffness: sp.csc_array, subspace: FloatArray
) -> tuple[ComplexArray, ComplexArray]:
    """Eigenpairs of the damped problem projected on the subspace, upper half plane only.

    Parameters
    ----------
    mass, damping, stiffness : (N, N) sparse array
        Symmetric.
    subspace : (N, s) array
        Its basis.

    Returns
    -------
    (S,) complex array
        Eigenvalues [1/s] in ascending modulus.
    (N, S) complex array
        Their modes, of any norm.
    """
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


def lowest_states(eigenvalues: ComplexArray, mode_pairs: int) -> slice:
    """Take the lowest states until ``2 * mode_pairs`` are reached; no complex pair is split.

    Parameters
    ----------
    eigenvalues : (S,) complex array
        Those of `modes_in`: a complex one stands for a pair.
    mode_pairs : int
        Pairs wanted; two real eigenvalues count as one.
    """
    states = np.cumsum(np.where(eigenvalues.imag == 0.0, 1, 2))
    return slice(0, int(np.searchsorted(states, 2 * mode_pairs, side="right")))
