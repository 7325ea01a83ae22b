"""What every support of a scenario is made of: linear springs and dampers, gaps, fastenings."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp

from track_fmu.parameters import GRAVITY

from ..errors import InputError
from ..support_values import support_properties

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from track_fmu.assembly import TrackMatrices

    from ..scenario import Scenario
    from ..track_section import Track

    Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LinearSupports:
    """Springs and dampers of all supports, each of shape (supports,).

    Attributes
    ----------
    pad_stiffness, pad_damping, ballast_stiffness, ballast_damping : ndarray
        [N/m], [N s/m].
    """

    pad_stiffness: Array
    pad_damping: Array
    ballast_stiffness: Array
    ballast_damping: Array

    def put_into(self, matrices: TrackMatrices, nominal: LinearSupports) -> TrackMatrices:
        """Return the matrices of a nominal track with these springs and dampers instead.

        Ballast under sleepers that bend must be the nominal one.
        """
        pads, beds = matrices.pad_incidence, matrices.ballast_incidence

        def changed(matrix: sp.csc_array, pad: Array, bed: Array) -> sp.csc_array:
            for part, change in ((pads, pad), (beds, bed)):
                if change.any():
                    matrix = matrix + part @ sp.diags_array(change) @ part.T
            return sp.csc_array(matrix)

        return replace(
            matrices,
            stiffness=changed(
                matrices.stiffness,
                self.pad_stiffness - nominal.pad_stiffness,
                self.ballast_stiffness - nominal.ballast_stiffness,
            ),
            damping=changed(
                matrices.damping,
                self.pad_damping - nominal.pad_damping,
                self.ballast_damping - nominal.ballast_damping,
            ),
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SupportProperties:
    """All supports of a track, each of shape (supports,).

    Attributes
    ----------
    nominal, own : LinearSupports
        Springs and dampers where all supports are alike; and with their factors.
    pad_stiffness, pad_damping, ballast_stiffness, ballast_damping : ndarray
        Those factors.
    gap : ndarray
        Under the unloaded sleeper [m].
    dead_load : ndarray
        What the ballast bears of the weight of sleeper and rail, as far as it can lose it [N]; 0
        under a gap.
    sleeper_lifts : ndarray of bool
        Whether the ballast lets go of a sleeper that rises.
    rail_lifts : ndarray of bool
        Whether the pad lets go of a rail that rises.
    """

    nominal: LinearSupports
    own: LinearSupports
    pad_stiffness: Array
    pad_damping: Array
    ballast_stiffness: Array
    ballast_damping: Array
    gap: Array
    dead_load: Array
    sleeper_lifts: NDArray[np.bool_]
    rail_lifts: NDArray[np.bool_]


def properties_of(scenario: Scenario, track: Track) -> SupportProperties:
    """Return the supports of a scenario's track, or of what is held of an endless one.

    Raises
    ------
    InputError
        For a table that cannot be used, or an endless track whose supports differ.
    """
    given = support_properties(scenario)
    if scenario.track.endless:
        given = {name: _everywhere(values, track.bays - 1) for name, values in given.items()}
    names = ("pad_stiffness", "pad_damping", "ballast_stiffness", "ballast_damping")
    factors = {name: given[f"{name}_factor"] for name in names}
    nominal = {name: np.full(len(factors[name]), getattr(track, name)) for name in names}
    lifts = (given["gap"] > 0.0) | (not track.ballast_pulls)
    mass = track.sleeper_mass * given["sleeper_mass_factor"]
    mass += track.mass_per_length * track.sleeper_spacing
    rests = lifts & (given["gap"] == 0.0) & (factors["ballast_stiffness"] > 0.0)
    return SupportProperties(
        nominal=LinearSupports(**nominal),
        own=LinearSupports(**{name: factors[name] * nominal[name] for name in names}),
        **factors,
        gap=given["gap"],
        dead_load=np.where(rests, GRAVITY * mass, 0.0),
        sleeper_lifts=lifts,
        rail_lifts=given["fastened"] == 0.0,
    )


def _everywhere(values: Array, supports: int) -> Array:
    """Return what all supports of an endless track have."""
    if (values != values[0]).any():
        raise InputError(
            "track.endless is true and supports differ, but the monolithic solution holds endless "
            "tracks of equal supports only: leave track.endless out, with as many track.bays as "
            "the run takes"
        )
    return np.full(supports, values[0])
