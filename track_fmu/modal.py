"""Truncated complex modal model of the linear track, Eq. (2)-(12)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .assembly import TrackMatrices
from .beam_element import FloatArray
from .eigensolver import ComplexArray, solve_damped


@dataclass(frozen=True, slots=True, kw_only=True)
class ModalBasis:
    """Retained modes; nodal displacements are ``x(t) = Re sum_n weight_n rho_n q_n(t)``.

    One of each complex-conjugate pair is kept and counts twice; a real (overdamped) eigenvalue
    counts once, so its first-order state stays real. The modes are normalised to ``a_n = 1``.

    Attributes
    ----------
    eigenvalues : (S,) complex array
        ``lambda_n = i omega_n`` [1/s], ascending modulus.
    modes : (N, S) complex array
        ``rho^(n)``, one column per mode.
    """

    eigenvalues: ComplexArray
    modes: ComplexArray

    @property
    def weight(self) -> FloatArray:
        """How often a mode counts, shape (S,): 2 for a complex pair, 1 for a real state."""
        return np.where(self.eigenvalues.imag == 0.0, 1.0, 2.0)


def compute_basis(matrices: TrackMatrices, *, mode_pairs: int) -> ModalBasis:
    """Solve the damped eigenvalue problem of the linear track.

    Parameters
    ----------
    matrices : TrackMatrices
        The assembled track.
    mode_pairs : int
        Retained complex-conjugate pairs ``M``; two overdamped real states count as one pair.

    Raises
    ------
    ValueError
        If ``mode_pairs`` exceeds the number of degrees of freedom.
    EigenvalueError
        If a mode cannot be determined.
    """
    pairs = solve_damped(
        matrices.mass,
        matrices.damping,
        matrices.stiffness,
        matrices.dampers,
        mode_pairs=mode_pairs,
    )
    return ModalBasis(eigenvalues=pairs.eigenvalues, modes=pairs.modes)
