"""What every support of a scenario is made of: springs and dampers, masses, gaps, fastenings."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp

from fmu_src.python.supports import PROPERTIES
from track_fmu.parameters import GRAVITY

from ..support_values import support_properties

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from track_fmu.assembly import TrackMatrices

    from ..scenario import Scenario
    from ..track_section import Track

    Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LinearSupports:
    """Springs, dampers and masses of all supports, each of shape (supports,).

    Attributes
    ----------
    pad_stiffness, pad_damping, ballast_stiffness, ballast_damping : ndarray
        [N/m], [N s/m].
    sleeper_mass : ndarray
        Of each sleeper beyond a nominal one [kg].
    ballast_mass : ndarray
        Of the ballast that moves along [kg].
    """

    pad_stiffness: Array
    pad_damping: Array
    ballast_stiffness: Array
    ballast_damping: Array
    sleeper_mass: Array
    ballast_mass: Array

    @property
    def mass(self) -> Array:
        """What moves with each sleeper beyond a nominal one [kg]."""
        return self.sleeper_mass + self.ballast_mass

    def put_into(self, matrices: TrackMatrices, nominal: LinearSupports) -> TrackMatrices:
        """Return the matrices of a nominal track with these springs, dampers and masses instead.

        Springs and dampers of the ballast under sleepers that bend must be the nominal ones.
        """
        still = np.zeros_like(self.pad_stiffness)
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
            mass=changed(matrices.mass, still, self.mass - nominal.mass),
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SupportProperties:
    """All supports of a track, each of shape (supports,).

    Attributes
    ----------
    nominal, own : LinearSupports
        Springs and dampers where all supports are alike, without masses beyond nominal sleepers;
        and all of it with their factors, of ballast that is not pressed.
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


def properties_of(scenario: Scenario, track: Track, *, first_bay: int = 0) -> SupportProperties:
    """Return the supports of a scenario's track, or of what is held of an endless one.

    Parameters
    ----------
    scenario : Scenario
        Says what supports have.
    track : Track
        Says how many there are.
    first_bay : int
        Bays between 0 m and the first end of that; before 0 m supports are nominal.

    Raises
    ------
    InputError
        For a table that cannot be used.
    """
    number = first_bay + np.arange(track.bays - 1)
    given = {
        name: np.where(number < 0, PROPERTIES[name], values[np.maximum(number, 0)])
        for name, values in support_properties(scenario).items()
    }
    names = ("pad_stiffness", "pad_damping", "ballast_stiffness", "ballast_damping")
    factors = {name: given[f"{name}_factor"] for name in names}
    nominal = {name: np.full(len(number), getattr(track, name)) for name in names}
    nothing = np.zeros(len(number))
    lifts = (given["gap"] > 0.0) | (not track.ballast_pulls)
    mass = track.sleeper_mass * given["sleeper_mass_factor"]
    mass += track.mass_per_length * track.sleeper_spacing
    rests = lifts & (given["gap"] == 0.0) & (factors["ballast_stiffness"] > 0.0)
    return SupportProperties(
        nominal=LinearSupports(**nominal, sleeper_mass=nothing, ballast_mass=nothing),
        own=LinearSupports(
            **{name: factors[name] * nominal[name] for name in names},
            sleeper_mass=(given["sleeper_mass_factor"] - 1.0) * track.sleeper_mass,
            ballast_mass=np.full(len(number), track.ballast_mass),
        ),
        **factors,
        gap=given["gap"],
        dead_load=np.where(rests, GRAVITY * mass, 0.0),
        sleeper_lifts=lifts,
        rail_lifts=given["fastened"] == 0.0,
    )
