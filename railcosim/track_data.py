"""The section `[track]` of a scenario as the linear track of the track model."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING

from track_fmu.parameters import TrackParameters

from .support_values import support_properties

if TYPE_CHECKING:
    from .scenario import Scenario
    from .track_section import Track


def is_linear(scenario: Scenario) -> bool:
    """Return whether all pads and all ballast are springs and dampers, whatever their load.

    Raises
    ------
    InputError
        For a table of supports that cannot be used.
    """
    track, own = scenario.track, support_properties(scenario)
    opens = not track.ballast_pulls or own["gap"].any() or not own["fastened"].all()
    return track.ballast == "linear" and track.pad == "linear" and not opens


def track_parameters(track: Track) -> TrackParameters:
    """Return the parameters of the linear track."""
    names = [item.name for item in fields(TrackParameters)]
    return TrackParameters(**{name: getattr(track, name) for name in names})
