"""The part of an endless track that the model holds: a window that moves after the wheels.

The window is as long as the track. Its first end stands a whole number of bays, the offset, from
the origin of the positions. It moves by several bays at once, as soon as the middle of the wheels
is half of that, and half a bay more, from its own middle: a vehicle that turns round there does
not move it to and fro.
"""

from __future__ import annotations

from collections.abc import Callable

from .beam_element import FloatArray
from .contact_point import RailPoint, locate
from .reduction import ReducedTrack
from .track_state import TrackState
from .window_shift import WindowShift

MOVES_PER_LENGTH = 5  # it moves by a fifth of its length
FARTHEST = 1e9  # m; beyond it positions lose the digits of a step


class Window:
    """Where the held part of a track lies; that of an ordinary track begins at 0 m and stays.

    Parameters
    ----------
    track : ReducedTrack
        Modes and residual flexibility.
    state : TrackState
        Holds the offset and is moved with it.
    endless : bool
        Whether it moves.
    """

    def __init__(self, track: ReducedTrack, state: TrackState, *, endless: bool) -> None:
        self._parameters, self._state = track.parameters, state
        self._shift = WindowShift(track) if endless else None

    @property
    def endless(self) -> bool:
        """Whether it moves."""
        return self._shift is not None

    @property
    def bays_before(self) -> int | None:
        """Bays before its beginning, None for an ordinary track."""
        return round(float(self._state.offset[0])) if self.endless else None

    @property
    def position(self) -> float:
        """Where it begins [m]."""
        return float(self._state.offset[0]) * self._parameters.sleeper_spacing

    def locate(self, positions: FloatArray) -> list[RailPoint]:
        """Points of the rail at positions [m] within the window.

        Raises
        ------
        ValueError
            If one is not.
        """
        begin = self.position if self.endless else None
        return [locate(self._parameters, float(x), window=begin) for x in positions]

    def find(self, position: float) -> RailPoint | None:
        """Point of the rail at a position [m], None where an endless track is not held."""
        begin = self.position
        if self.endless and not 0.0 <= position - begin <= self._parameters.length:
            return None
        return locate(self._parameters, position, window=begin if self.endless else None)

    def check(self, positions: FloatArray) -> None:
        """Refuse wheel positions [m] that no step can lead to, before anything has changed.

        Raises
        ------
        ValueError
            If a wheel is beyond an ordinary track or its position is not a number.
        """
        if not self.endless:
            self.locate(positions)
            return
        for position in positions:
            if not abs(position) <= FARTHEST:
                raise ValueError(
                    f"track: position {float(position)!r} m must be a number of at most "
                    f"{FARTHEST:g} m; look for the cause in the vehicle"
                )

    def centre(self, positions: FloatArray) -> None:
        """Lay it around wheels at the start."""
        self._state.offset[:] = round(self._bays_ahead(positions, 0.0)) if self.endless else 0

    def follow(self, forces: Callable[[], FloatArray]) -> bool:
        """Move it after the wheels if they have left its middle; say whether it has moved.

        What a step begins with. It depends on the state alone, so that a repeated step is the same
        bit for bit.

        Parameters
        ----------
        forces : callable
            Gives the forces on the coordinates, shape (n,).
        """
        bays = self._due_bays() if self._shift is not None else 0
        if self._shift is None or bays == 0:
            return False
        before = forces()
        self._state.offset += bays
        wheels = self.locate(self._state.position)
        self._shift.apply(self._state, bays, forces=before, wheels=wheels)
        return True

    def _due_bays(self) -> int:
        """Bays by which it has to move now, below zero for wheels that run back."""
        bays = max(1, self._parameters.bays // MOVES_PER_LENGTH)
        ahead = self._bays_ahead(self._state.position, float(self._state.offset[0]))
        limit = 0.5 * (bays + 1)
        if ahead > limit:
            return bays
        return -bays if ahead < -limit else 0

    def _bays_ahead(self, positions: FloatArray, offset: float) -> float:
        """How far the middle of the wheels is ahead of its own [bays]."""
        middle = 0.5 * (float(positions.max()) + float(positions.min()))
        return middle / self._parameters.sleeper_spacing - 0.5 * self._parameters.bays - offset
