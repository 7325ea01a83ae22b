"""Static equilibrium of the whole track under wheels that roll on steadily."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from ..errors import RunError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from track_fmu.assembly import TrackMatrices

    from .laws import BallastLaw

MOST_ITERATIONS = 60
SETTLED = 1e-13
"""Relative change of the displacements at which the iteration ends."""


def static_start(
    matrices: TrackMatrices,
    ballast: BallastLaw,
    *,
    load: NDArray[np.float64],
    load_rate: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Solve ``K x + C x' + D_b g(x, x') = f``, with the velocity of a deflection that moves along.

    Inertia is left out, as in a track that follows its loads without delay.

    Parameters
    ----------
    matrices : TrackMatrices
        The linear track.
    ballast : BallastLaw
        Of every support.
    load, load_rate : ndarray, shape (N,)
        Nodal forces of the wheels [N] and their rate as the wheels move [N/s].

    Returns
    -------
    tuple of ndarray, shape (N,)
        Displacements [m] and velocities [m/s].

    Raises
    ------
    RunError
        If no equilibrium is found.
    """
    beds = matrices.ballast_incidence
    displacement = np.zeros_like(load)
    for _ in range(MOST_ITERATIONS):
        sinking = beds.T @ displacement
        at_rest = ballast.tangent(sinking, np.zeros_like(sinking))
        tangent = beds @ sp.diags_array(at_rest.stiffness) @ beds.T
        factor = splu(sp.csc_array(matrices.stiffness + tangent))
        velocity = factor.solve(load_rate)
        rate = beds.T @ velocity
        force = ballast.tangent(sinking, rate).force
        miss = load - matrices.stiffness @ displacement - matrices.damping @ velocity - beds @ force
        change = factor.solve(miss)
        displacement = displacement + change
        if np.abs(change).max() <= SETTLED * np.abs(displacement).max():
            return displacement, velocity
    raise RunError(
        f"the static equilibrium at the start is not found in {MOST_ITERATIONS} iterations: check "
        "the coefficients track.ballast_alpha, ballast_beta and ballast_delta"
    )
