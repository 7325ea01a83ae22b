"""State-dependent ballast about the static equilibrium under a preload."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from track_fmu.supports import nearest_supports
from track_fmu.track_model import TrackModel, TrackOptions

from ..errors import RunError

if TYPE_CHECKING:
    from track_fmu.assembly import IntArray
    from track_fmu.ballast import PolynomialBallast
    from track_fmu.beam_element import FloatArray
    from track_fmu.reduction import ReducedTrack


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BallastTangent:
    """What the ballast has more of, for small motions, than the linear ballast.

    Attributes
    ----------
    stiffness, damping : (supports,) float array
        Tangent of Eq. (27) [N/m] and secant damping of Eq. (30) [N s/m] under every sleeper.
    """

    stiffness: FloatArray
    damping: FloatArray

    @property
    def loaded(self) -> IntArray:
        """Numbers (from 0) of the sleepers with any of it."""
        return np.flatnonzero((self.stiffness != 0.0) | (self.damping != 0.0))


def ballast_tangent(
    track: ReducedTrack,
    law: PolynomialBallast,
    *,
    position: float,
    force: float,
    supports_per_wheel: int,
) -> BallastTangent:
    """Linearise the ballast about the equilibrium under a standing load on the rail.

    Parameters
    ----------
    track : ReducedTrack
        The linear track, with residual flexibility, so that its statics are exact.
    law : PolynomialBallast
        State-dependent part of the ballast.
    position : float
        Of the load along the rail [m].
    force : float
        The load [N], downwards positive.
    supports_per_wheel : int
        Number of nearest supports that are state-dependent.

    Raises
    ------
    RunError
        If there is no equilibrium.
    """
    model = TrackModel(
        track, TrackOptions(wheels=1, supports_per_wheel=supports_per_wheel), ballast=law
    )
    place = np.array([position])
    try:
        model.start(place, np.array([force]))
    except RuntimeError as error:
        raise RunError(str(error)) from error
    supports = np.arange(track.parameters.supports)
    sunk = model.observe().ballast_deformation
    near = np.isin(supports, nearest_supports(track.parameters, place, supports_per_wheel))
    rest = np.zeros_like(sunk)
    return BallastTangent(
        stiffness=np.where(near, law.stiffness(sunk, rest, supports), 0.0),
        damping=np.where(near, law.damping(sunk, rest, supports), 0.0),
    )
