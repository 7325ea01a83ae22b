"""Dynamic stiffness of the assembled track, solved frequency by frequency."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import scipy.linalg as la
import scipy.sparse as sp

from track_fmu.assembly import assemble, half_bandwidth, to_banded

from ..errors import RunError

if TYPE_CHECKING:
    from track_fmu.beam_element import FloatArray
    from track_fmu.eigensolver import ComplexArray
    from track_fmu.parameters import TrackParameters

    from .points import TrackPoint
    from .preload import SupportTangent


class DynamicStiffness:
    """``Z(omega) = K + i omega C - omega^2 M`` of the whole track, without modes.

    Parameters
    ----------
    parameters : TrackParameters
        The linear track.
    tangent : SupportTangent, optional
        What pads and ballast have more of.
    """

    def __init__(self, parameters: TrackParameters, tangent: SupportTangent | None = None) -> None:
        self.matrices = assemble(parameters)
        matrices = self.matrices
        stiffness, damping, mass = matrices.stiffness, matrices.damping, matrices.mass
        self._branches: SupportTangent | None = None
        if tangent is not None:
            ports, small = tangent.incidence, tangent.small
            stiffness = stiffness + ports @ sp.diags_array(small.stiffness) @ ports.T
            damping = damping + ports @ sp.diags_array(small.damping) @ ports.T
            mass = mass + ports @ sp.diags_array(small.mass) @ ports.T
            if small.branch_stiffness.any():
                self._branches = tangent
        self._width = half_bandwidth(stiffness, damping, mass)
        self._stiffness, self._damping, self._mass = (
            _both_triangles(to_banded(matrix, self._width)) for matrix in (stiffness, damping, mass)
        )

    def load(self, point: TrackPoint) -> FloatArray:
        """Forces on the degrees of freedom, shape (N,), of a unit force at a point."""
        force = np.zeros(self.matrices.numbering.size)
        free = point.dofs >= 0
        force[point.dofs[free]] = point.weights[free]
        return force

    def solve(self, frequency: float, forces: FloatArray) -> ComplexArray:
        """Amplitudes ``Z^-1 f`` at a frequency.

        Parameters
        ----------
        frequency : float
            Of the excitation [Hz]; 0 is static.
        forces : (N,) or (N, k) float array
            Amplitudes of the forces on the degrees of freedom [N].

        Returns
        -------
        complex array
            Of the displacements [m], in the shape of ``forces``.

        Raises
        ------
        RunError
            If the parameters of the track are such that there is no finite answer.
        """
        omega = 2.0 * np.pi * frequency
        with np.errstate(over="ignore", invalid="ignore"):  # the answer is looked at below
            matrix: ComplexArray = self._stiffness + (1j * omega) * self._damping
            matrix -= omega**2 * self._mass
            if self._branches is not None:
                matrix += self._of_branches(self._branches, omega)
            try:
                answer = la.solve_banded(
                    (self._width, self._width),
                    matrix,
                    forces.astype(complex),
                    overwrite_ab=True,
                    overwrite_b=True,
                    check_finite=False,
                )
            except la.LinAlgError:
                answer = np.full(forces.shape, np.nan, dtype=complex)
        if not np.isfinite(answer).all():
            raise RunError(
                f"the track has no receptance at {frequency:g} Hz with these parameters: check the "
                "magnitude of the keys of [track]"
            )
        return np.asarray(answer)

    def _of_branches(self, tangent: SupportTangent, omega: float) -> ComplexArray:
        """What branches of spring and dashpot add, as a band."""
        ports = tangent.incidence
        added = sp.csc_array(ports @ sp.diags_array(tangent.branches(omega)) @ ports.T)
        real, imaginary = (
            _both_triangles(to_banded(part, self._width)) for part in (added.real, added.imag)
        )
        return np.asarray(real + 1j * imaginary)

    def receptance(
        self, frequencies: FloatArray, *, load: TrackPoint, response: TrackPoint
    ) -> ComplexArray:
        """Displacement at one point over the force at another [m/N].

        Parameters
        ----------
        frequencies : (n,) float array
            Of the excitation [Hz].
        load, response : TrackPoint
            Where the force acts and where the displacement is taken.

        Returns
        -------
        (n,) complex array
            Its argument is the phase by which the displacement leads the force.
        """
        force, observed = self.load(load), self.load(response)
        return np.array([observed @ self.solve(float(f), force) for f in frequencies])


def _both_triangles(lower: FloatArray) -> FloatArray:
    """Band storage of a symmetric matrix, shape (2 b + 1, N), from that of its lower triangle."""
    width, size = lower.shape[0] - 1, lower.shape[1]
    band = np.zeros((2 * width + 1, size))
    band[width:] = lower
    for k in range(1, min(width + 1, size)):
        band[width - k, k:] = lower[k, : size - k]
    return band
