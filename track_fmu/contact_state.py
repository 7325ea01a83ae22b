"""What a track with contacts remembers beside the track's own state, as one flat array."""

from __future__ import annotations

import numpy as np

from .beam_element import FloatArray


class ContactState:
    """Named views into one float64 array.

    Attributes
    ----------
    flat : (size,) float array
        The state; all other attributes are views into it.
    compression, ahead, origin : (wheels,) float array
        Compressions [m], expected contact forces [N], and what displacements count from [m].
    velocity, mean_velocity : (wheels,) float array
        Of the surface under the wheels at the start, and in the mean over a second [m/s].
    history : (3, 2 wheels) float array
        Positions and displacements as last given [m]; see `continuation`.
    ages : (2,) float array
        How long before the newest the other two were given [s].
    passed : (1,) float array
        Time since the newest were given [s].
    """

    __slots__ = (
        "ages",
        "ahead",
        "compression",
        "flat",
        "history",
        "mean_velocity",
        "origin",
        "passed",
        "velocity",
    )

    def __init__(self, *, wheels: int) -> None:
        self.flat: FloatArray = np.zeros(11 * wheels + 3)
        lengths = [wheels] * 5 + [6 * wheels, 2, 1]
        parts = np.split(self.flat, np.cumsum(lengths)[:-1])  # views, not copies
        self.compression, self.ahead, self.origin = parts[:3]
        self.velocity, self.mean_velocity = parts[3:5]
        self.history: FloatArray = parts[5].reshape(3, 2 * wheels)
        self.ages, self.passed = parts[6:]
