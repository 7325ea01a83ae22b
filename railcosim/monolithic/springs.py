"""Springs with bump stops and one-sided dampers between the bodies of a vehicle."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Spring:
    """A spring beside a damper and a bump stop; see `Springs` for its force.

    Attributes
    ----------
    stiffness, damping : float
        [N/m]; of the damper while it is compressed [N s/m].
    rebound_ratio : float
        Damping while it is extended over that while it is compressed.
    clearance : float
        Compression from static equilibrium at which the stop is met [m].
    stop_stiffness : float
        Of the stop, beside the spring [N/m].
    """

    stiffness: float
    damping: float
    rebound_ratio: float = 1.0
    clearance: float = 0.0
    stop_stiffness: float = 0.0


class Springs:
    """The forces of n springs beyond those of static equilibrium.

    Every force is an integral over the compression: ``k`` all the way, ``k_stop`` over the part of
    the way from static equilibrium on which the stop is met.

    Parameters
    ----------
    springs : sequence of Spring
        All of them.
    """

    def __init__(self, springs: list[Spring]) -> None:
        self._stiffness, self._damping, ratio, self._clearance, self._stop = (
            np.array([getattr(spring, name) for spring in springs])
            for name in (
                "stiffness",
                "damping",
                "rebound_ratio",
                "clearance",
                "stop_stiffness",
            )
        )
        self._rebound = ratio * self._damping
        self._stops = np.flatnonzero(self._stop)

    def force(self, compression: Array, rate: Array) -> Array:
        """Return the forces [N] at compressions [m] and their rates [m/s], shape (..., n)."""
        met = np.maximum(compression, self._clearance) - np.maximum(0.0, self._clearance)
        damping = np.where(rate < 0.0, self._rebound, self._damping)
        return np.asarray(self._stiffness * compression + self._stop * met + damping * rate)

    def tangent(self, compression: Array, rate: Array) -> tuple[Array, Array]:
        """Return their derivatives by compression [N/m] and rate [N s/m], shape (n,) each."""
        met = compression > self._clearance
        damping = np.where(rate < 0.0, self._rebound, self._damping)
        return self._stiffness + self._stop * met, damping

    def ways_to_stops(self, compression: Array) -> Array:
        """Return how far from its stop every spring that has one is [m], below zero where met."""
        return np.asarray((self._clearance - compression)[self._stops])
