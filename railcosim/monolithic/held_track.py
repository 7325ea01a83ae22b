"""How much of the rail the solution holds, which of an endless track is what the passage needs."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from ..errors import InputError

if TYPE_CHECKING:
    from ..scenario import Scenario
    from ..track_section import Track

MOST_BAYS = 400
"""Of an endless track; the system then has 13 600 states."""


@dataclass(frozen=True, slots=True, kw_only=True)
class HeldTrack:
    """A track between clamped ends, on which all of the passage takes place.

    Attributes
    ----------
    keys : Track
        Its properties; those of the scenario but for bays and modes.
    first_bay : int
        Bays between 0 m and its first end; below zero where that is before 0 m.
    """

    keys: Track
    first_bay: int

    @property
    def begin(self) -> float:
        """Position of its first end [m]."""
        return self.first_bay * self.keys.sleeper_spacing

    def sleepers_of(self, scenario: Scenario) -> slice:
        """Return which of the sleepers a result of the scenario has: those around the flat."""
        first = scenario.first_bay - self.first_bay
        return slice(first, first + scenario.track.bays - 1)


def held_track(scenario: Scenario) -> HeldTrack:
    """Return the track of a scenario, or as much of an endless one as all wheels need.

    Of an endless track that is the way of all wheels and, before and behind it, half a track of
    the scenario, so that the ends are at least as far as those of a window that moves. It has as
    many modes a bay, up to the same frequency.

    Raises
    ------
    InputError
        If a passage over an endless track needs more than `MOST_BAYS`.
    """
    track = scenario.track
    if not track.endless:
        return HeldTrack(keys=track, first_bay=0)
    beside = track.bays // 2 + 1
    last_wheel = scenario.start_position - scenario.vehicle.offsets[-1]
    first = math.floor(last_wheel / track.sleeper_spacing) - beside
    ahead = (scenario.start_position + scenario.distance) / track.sleeper_spacing
    bays = math.ceil(ahead) + beside - first
    if bays > MOST_BAYS:
        way = (bays - MOST_BAYS) * track.sleeper_spacing
        raise InputError(
            f"the passage takes {bays} bays of the endless track, but the monolithic solution "
            f"holds at most {MOST_BAYS}: make run.approach and run.departure {way:g} m shorter "
            "together"
        )
    pairs = math.ceil(bays * track.retained_pairs / track.bays)
    keys = replace(track, bays=bays, endless=False, mode_pairs=pairs)
    return HeldTrack(keys=keys, first_bay=first)
