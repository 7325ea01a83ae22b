"""What every wheel rolls over: the drops of its tread and of the railhead under it."""

import numpy as np

from .irregularity import RailIrregularity
from .parameters import FlatParameters
from .validation import FloatArray, require_positive
from .wheel_profile import Profile, WheelProfileTable, check_flat, flat_along_rail


def surface_profiles(
    flat: FlatParameters,
    flat_table: WheelProfileTable | None,
    irregularity: RailIrregularity | None,
    *,
    wheels: int,
    radius: float,
) -> list[Profile]:
    """Return the sum of tread and railhead drop over the position along the rail, for each wheel.

    Parameters
    ----------
    flat, flat_table
        The flat on one of the wheels, already checked.
    irregularity : RailIrregularity or None
        The railhead's irregularity; None is a perfect rail.
    wheels : int
        Number of wheels.
    radius : float
        Of the wheels [m].
    """
    rail = None if irregularity is None else irregularity.curve()
    profiles = [_sum(None, rail)] * wheels
    if flat.shape != "none":
        tread = flat_along_rail(flat, flat_table, radius=radius)
        profiles[flat.wheel - 1] = _sum(tread, rail)
    return profiles


class Surfaces:
    """Drops of tread and railhead at given wheel positions.

    Parameters
    ----------
    flat, flat_table, irregularity, wheels, radius
        See `surface_profiles`.

    Raises
    ------
    ValueError
        If the radius is not above zero, the flat is on none of the wheels, does not fit, or its
        shape and table do not go together.
    """

    def __init__(
        self,
        flat: FlatParameters,
        *,
        flat_table: WheelProfileTable | None,
        irregularity: RailIrregularity | None,
        wheels: int,
        radius: float,
    ) -> None:
        require_positive("wheel_radius", radius, "m", "give half the wheel diameter")
        check_flat(flat, flat_table, radius=radius, wheels=wheels)
        self._profiles = surface_profiles(
            flat, flat_table, irregularity, wheels=wheels, radius=radius
        )

    def drops(self, positions: FloatArray) -> FloatArray:
        """Return the drop under every wheel [m] at its position [m], shape (wheels,)."""
        pairs = zip(self._profiles, positions.tolist(), strict=True)
        return np.array([profile(x) for profile, x in pairs])


def _sum(tread: Profile | None, rail: Profile | None) -> Profile:
    """Return the sum of two profiles of which either may be missing."""
    if tread is None:
        return rail if rail is not None else _no_drop
    if rail is None:
        return tread
    return lambda x: tread(x) + rail(x)


def _no_drop(_: float) -> float:
    return 0.0
