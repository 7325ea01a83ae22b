"""The section `[track]` of a scenario as parameters and force law of the track model."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING

from track_fmu.ballast import PolynomialBallast
from track_fmu.parameters import TrackParameters

from .errors import InputError
from .track_section import Track
from .variation import Variation

if TYPE_CHECKING:
    from .scenario import Scenario

PAPER = ("ballast_tangent_damping", "ballast_pulls", "ballast_mass", "pad", "supports")
"""Keys of the track without which its laws are those of the paper."""


def require_paper_laws(scenario: Scenario, what: str) -> None:
    """Refuse laws of pads and ballast, and supports that differ, where they are not known.

    Raises
    ------
    InputError
        That names the key to leave out.
    """
    usual, track = Track(), scenario.track
    keys = [f"track.{key}" for key in PAPER if getattr(track, key) != getattr(usual, key)]
    if track.ballast not in ("state_dependent", "linear"):
        keys.insert(0, "track.ballast")
    if scenario.variation != Variation():
        keys.append("[variation]")
    if keys:
        raise InputError(
            f"{what} knows the ballast and the pads of the paper only, the same at every support: "
            f"leave {keys[0]} out"
        )


def track_parameters(track: Track) -> TrackParameters:
    """Return the parameters of the linear track."""
    names = [item.name for item in fields(TrackParameters)]
    return TrackParameters(**{name: getattr(track, name) for name in names})


def ballast_law(track: Track) -> PolynomialBallast | None:
    """Return the law of the state-dependent ballast, Eq. (27) and (30), or None if it is linear."""
    if track.ballast == "linear":
        return None
    return PolynomialBallast(
        alpha=track.ballast_alpha,
        beta=track.ballast_beta,
        delta=track.ballast_delta,
        tau=track.ballast_damping / track.ballast_stiffness,
    )
