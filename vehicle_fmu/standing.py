"""How wheels stand and move at the start, where the track that has the contacts tells it."""

from dataclasses import dataclass

import numpy as np

from .validation import FloatArray


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Standing:
    """Heights and velocities of wheels in static equilibrium; arrays of shape (wheels,).

    Attributes
    ----------
    displacement : ndarray
        Of the wheels from any level [m], positive downwards.
    velocity : ndarray
        With which they follow the surface under them [m/s].
    mean_velocity : ndarray
        With which bodies above them follow it, in the mean over a longer time [m/s].

    Raises
    ------
    ValueError
        If a value is not finite.
    """

    displacement: FloatArray
    velocity: FloatArray
    mean_velocity: FloatArray

    def __post_init__(self) -> None:
        for name, unit in (("displacement", "m"), ("velocity", "m/s"), ("mean_velocity", "m/s")):
            values = getattr(self, name)
            bad = np.flatnonzero(~np.isfinite(values))
            if bad.size:
                raise ValueError(
                    f"the static {name} of wheel {bad[0] + 1} is {values[bad[0]]:g} {unit}; it "
                    "must be a finite number"
                )


def level(wheels: int) -> Standing:
    """Return wheels at rest on a level rail."""
    return Standing(
        displacement=np.zeros(wheels), velocity=np.zeros(wheels), mean_velocity=np.zeros(wheels)
    )
