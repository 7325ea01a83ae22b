"""Static equilibrium of the whole track under wheels that roll on steadily."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from ..errors import RunError
from .full_track import port_incidence

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from scipy.sparse.linalg import SuperLU

    from track_fmu.assembly import TrackMatrices

    from .support_laws import SmallMotion, SupportLaws

MOST_ITERATIONS = 200
SETTLED = 1e-11
"""Relative change of the displacements at which iterations end, above what rounding leaves."""

OVERSHOOT = 0.5
"""Slope of the energy behind a change over the fall before it, up to which it is taken."""

SMALLEST_SHARE = 1e-3
"""Of a change; where things close, Newton's whole one may lead uphill."""

ROUNDING = 1e-9
"""Of a tangent stiffness."""


def static_start(
    matrices: TrackMatrices,
    laws: SupportLaws,
    *,
    load: NDArray[np.float64],
    load_rate: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Solve ``K x + C x' + D g(x, x') = f``, with the velocity of a deflection that moves along.

    Inertia is left out, as in a track that follows its loads without delay. Branches of pads are
    relaxed. Where something can lift off, its dampers bear nothing and the velocity is found once,
    after the displacements: where gaps are about to close the iteration would go on without end.

    Parameters
    ----------
    matrices : TrackMatrices
        The linear track.
    laws : SupportLaws
        Of ballast and pads.
    load, load_rate : ndarray, shape (N,)
        Nodal forces of the wheels [N] and their rate as the wheels move [N/s].

    Returns
    -------
    tuple of ndarray, shape (N,)
        Displacements [m] and velocities [m/s].

    Raises
    ------
    RunError
        If no equilibrium is found, a part of the track is held by nothing, or the load on a
        component falls with its displacement there: then there are other equilibria.
    """
    ports = port_incidence(matrices, pad_ports=laws.pads_have_ports)
    loose = laws.loose()
    displacement, viscous = np.zeros_like(load), np.zeros_like(load)
    for _ in range(MOST_ITERATIONS):
        before = displacement
        displacement, small = _at_rest(matrices, laws, load - viscous, displacement)
        factor = _factor(matrices, ports, small)
        velocity = factor.solve(load_rate)
        if loose.any() and viscous.any():
            return displacement, velocity
        viscous = matrices.damping @ velocity
        viscous += ports @ (~loose * small.damping * (ports.T @ velocity))
        if np.abs(displacement - before).max() <= SETTLED * np.abs(displacement).max():
            return displacement, velocity
    raise _not_found()


def _at_rest(
    matrices: TrackMatrices,
    laws: SupportLaws,
    load: NDArray[np.float64],
    displacement: NDArray[np.float64],
) -> tuple[NDArray[np.float64], SmallMotion]:
    """Find the equilibrium under standing loads, by Newton's changes that lead down the energy."""
    ports = port_incidence(matrices, pad_ports=laws.pads_have_ports)
    change, fall, share = np.zeros_like(load), 0.0, 1.0
    for _ in range(MOST_ITERATIONS):
        small = laws.about_rest(ports.T @ displacement)
        miss = load - matrices.stiffness @ displacement - ports @ small.force
        if share > SMALLEST_SHARE and change @ miss < -OVERSHOOT * fall:
            share *= 0.5
            displacement = displacement - share * change
            continue
        change, share = _factor(matrices, ports, small).solve(miss), 1.0
        fall = float(change @ miss)
        displacement = displacement + change
        if np.abs(change).max() <= SETTLED * np.abs(displacement).max():
            _refuse_falling(laws, small)
            return displacement, small
    raise _not_found()


def _not_found() -> RunError:
    return RunError(
        f"the static equilibrium at the start is not found in {MOST_ITERATIONS} iterations: check "
        "the laws of ballast and pads in the section [track]"
    )


def _factor(matrices: TrackMatrices, ports: sp.csc_array, small: SmallMotion) -> SuperLU:
    """Factorise the tangent stiffness."""
    tangent = ports @ sp.diags_array(small.stiffness) @ ports.T
    try:
        return splu(sp.csc_array(matrices.stiffness + tangent))
    except RuntimeError as error:
        raise RunError(
            "a part of the track is held by nothing in static equilibrium: use loads on ballast "
            "and pads that rise with displacement"
        ) from error


def _refuse_falling(laws: SupportLaws, small: SmallMotion) -> None:
    """Refuse an equilibrium on a falling branch of a load-displacement curve."""
    base, nominal = laws.base, laws.supports.nominal
    linear = [base.ballast_stiffness, base.pad_stiffness]
    whole = small.stiffness + np.concatenate(linear)[: len(small.stiffness)]
    scale = np.concatenate([nominal.ballast_stiffness, nominal.pad_stiffness])[: len(whole)]
    worst = int(np.argmin(whole / scale))
    if whole[worst] < -ROUNDING * scale[worst]:
        supports = len(base.pad_stiffness)
        kind = "ballast" if worst < supports else "pad"
        raise RunError(
            f"the load on the {kind} of support {worst % supports + 1} falls with its displacement "
            f"in static equilibrium ({whole[worst]:.3g} N/m), which is not the only one then: use "
            "a law whose load rises"
        )
