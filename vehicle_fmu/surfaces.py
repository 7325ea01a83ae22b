"""What every wheel rolls over: the drops of its tread and of the railhead under it."""

from collections.abc import Sequence

import numpy as np

from .irregularity import RailIrregularity
from .out_of_roundness import OutOfRoundness, tread_along_rail
from .parameters import FlatParameters
from .validation import FloatArray, require_positive
from .wheel_profile import Profile, WheelProfileTable, check_flat, flat_along_rail


def surface_profiles(
    flat: FlatParameters,
    flat_table: WheelProfileTable | None,
    irregularity: RailIrregularity | None,
    *,
    out_of_roundness: Sequence[OutOfRoundness | None] = (),
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
    out_of_roundness : sequence of OutOfRoundness or None
        Of every wheel, None for a round one; empty where all are round. Angle zero meets the
        rail where the centre of the flat does.
    wheels : int
        Number of wheels.
    radius : float
        Of the wheels [m].
    """
    rail = None if irregularity is None else irregularity.curve()
    treads = [
        None if table is None else tread_along_rail(table, position=flat.position, radius=radius)
        for table in out_of_roundness
    ] or [None] * wheels
    if flat.shape != "none":
        struck = flat.wheel - 1
        treads[struck] = _sum(flat_along_rail(flat, flat_table, radius=radius), treads[struck])
    return [_sum(tread, rail) or _no_drop for tread in treads]


def check_out_of_roundness(tables: Sequence[OutOfRoundness | None], *, wheels: int) -> None:
    """Raise ValueError unless there is one entry a wheel, or none at all."""
    if len(tables) not in {0, wheels}:
        raise ValueError(
            f"out-of-roundness is given for {len(tables)} wheels, the vehicle has {wheels}; give "
            "one table a wheel, None for a round one"
        )


class Surfaces:
    """Drops of tread and railhead at given wheel positions.

    Parameters
    ----------
    flat, flat_table, irregularity, out_of_roundness, wheels, radius
        See `surface_profiles`.

    Raises
    ------
    ValueError
        If the radius is not above zero, the flat is on none of the wheels, does not fit, or its
        shape and table do not go together, or the number of tables is not that of the wheels.
    """

    def __init__(
        self,
        flat: FlatParameters,
        *,
        flat_table: WheelProfileTable | None,
        irregularity: RailIrregularity | None,
        out_of_roundness: Sequence[OutOfRoundness | None] = (),
        wheels: int,
        radius: float,
    ) -> None:
        require_positive("wheel_radius", radius, "m", "give half the wheel diameter")
        check_flat(flat, flat_table, radius=radius, wheels=wheels)
        check_out_of_roundness(out_of_roundness, wheels=wheels)
        self._profiles = surface_profiles(
            flat,
            flat_table,
            irregularity,
            out_of_roundness=out_of_roundness,
            wheels=wheels,
            radius=radius,
        )

    def drops(self, positions: FloatArray) -> FloatArray:
        """Return the drop under every wheel [m] at its position [m], shape (wheels,)."""
        pairs = zip(self._profiles, positions.tolist(), strict=True)
        return np.array([profile(x) for profile, x in pairs])


def _sum(one: Profile | None, other: Profile | None) -> Profile | None:
    """Return the sum of two profiles of which either or both may be missing."""
    if one is None or other is None:
        return one or other
    return lambda x: one(x) + other(x)


def _no_drop(_: float) -> float:
    return 0.0
