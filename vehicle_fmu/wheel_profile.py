"""How far the tread of a wheel lies below its round shape, as the wheel moves along the rail.

Shapes over a = |s| / (L / 2) <= 1, with s the distance from the flat's centre, L its length and
d its depth:

============ ==================================================
haversine    d / 2 (1 + cos(pi a))
parabola     d (1 - a^2)
cusp         d (1 - a)^2
chord        parabola with d = L^2 / (8 R), the fresh flat
table        measured, a smooth monotone curve through its points
============ ==================================================
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

from .interpolation import monotone_curve
from .parameters import FlatParameters
from .rolling import reach, rolled
from .validation import FloatArray, checked_table

Profile: TypeAlias = Callable[[float], float]
"""Drop [m], positive where metal is missing, over a distance or position [m]."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WheelProfileTable:
    """A measured tread profile.

    Attributes
    ----------
    distance : ndarray, shape (n >= 4,)
        Distance from the flat's centre [m], strictly increasing in the order in which the tread
        meets the rail.
    drop : ndarray, shape (n,)
        Missing material [m], negative where the tread is raised; zero at both ends.

    Raises
    ------
    ValueError
        If the columns are no table, the ends are not zero, or nothing is missing anywhere.
    """

    distance: FloatArray
    drop: FloatArray

    def __post_init__(self) -> None:
        distance, drop = checked_table(
            "wheel profile", ("distance [m]", self.distance), ("drop [m]", self.drop), least=4
        )
        for end in (0, -1):
            if drop[end] != 0.0:
                raise ValueError(
                    f"wheel profile: the drop is {drop[end]:g} m at its end {distance[end]:g} m; "
                    "it must be zero there, where the round tread goes on: add such a point"
                )
        if not (drop > 0.0).any():
            raise ValueError(
                f"wheel profile: the largest drop is {drop.max():g} m; it must be above zero "
                "somewhere: a drop is positive where metal is missing, change the sign"
            )
        object.__setattr__(self, "distance", distance)
        object.__setattr__(self, "drop", drop)


def _haversine(a: float) -> float:
    return 0.5 * (1.0 + math.cos(math.pi * a))


def _parabola(a: float) -> float:
    return 1.0 - a * a


def _cusp(a: float) -> float:
    return (1.0 - a) * (1.0 - a)


_RELATIVE_DROP: dict[str, Profile] = {
    "haversine": _haversine,
    "parabola": _parabola,
    "cusp": _cusp,
    "chord": _parabola,
}


def check_flat(
    flat: FlatParameters, table: WheelProfileTable | None, *, radius: float, wheels: int
) -> None:
    """Raise ValueError unless the flat has its table, if any, and fits on one of these wheels."""
    if (flat.shape == "table") != (table is not None):
        given = "no table is" if table is None else "a table is"
        raise ValueError(
            f"flat shape is {flat.shape!r} and {given} given; "
            "a table belongs to shape 'table' and to no other"
        )
    if flat.shape == "none":
        return
    if flat.wheel > wheels:
        raise ValueError(
            f"the flat is on wheel {flat.wheel}, the vehicle has {wheels}; "
            "give one of its wheels, counted from 1"
        )
    first, last = _extent(flat, table)
    length = last - first
    if table is not None and flat.rolled:
        length += 2.0 * reach(float(table.drop.min()), radius=radius)
    turn = 2.0 * math.pi * radius
    if length > turn:
        raise ValueError(
            f"the flat acts over {length:g} m, the wheel's circumference is {turn:g} m; "
            "a flat must fit on its wheel: give metres, not millimetres"
        )
    depth = _depth(flat, radius) if table is None else float(abs(table.drop).max())
    if depth >= radius:
        raise ValueError(
            f"the flat is {depth:g} m deep, the wheel's radius {radius:g} m; "
            "a flat must leave a wheel: give metres, not millimetres"
        )


def flat_profile(
    flat: FlatParameters, table: WheelProfileTable | None, *, radius: float
) -> Profile:
    """Return the drop over the distance s from the flat's centre, a single flat at s = 0."""
    first, last = _extent(flat, table)
    if table is None:
        drop = _shape(flat.shape, 0.5 * flat.length, _depth(flat, radius))
    else:
        drop = monotone_curve(table.distance, table.drop)
    return rolled(drop, first=first, last=last, radius=radius) if flat.rolled else drop


def flat_along_rail(
    flat: FlatParameters, table: WheelProfileTable | None, *, radius: float
) -> Profile:
    """Return the drop p(x) over the position x of the wheel along the rail.

    Parameters
    ----------
    flat : FlatParameters
        The flat; any shape but "none".
    table : WheelProfileTable or None
        The measured profile of shape "table".
    radius : float
        Wheel radius R [m]; a periodic flat comes back every 2 pi R.
    """
    drop = flat_profile(flat, table, radius=radius)
    centre = flat.position
    if not flat.periodic:
        return lambda x: drop(x - centre)
    turn = 2.0 * math.pi * radius

    def every_turn(x: float) -> float:
        s = x - centre
        return drop(s - turn * math.floor(s / turn + 0.5))

    return every_turn


def _shape(name: str, half_length: float, depth: float) -> Profile:
    relative_drop = _RELATIVE_DROP[name]

    def drop(s: float) -> float:
        a = abs(s) / half_length
        return depth * relative_drop(a) if a < 1.0 else 0.0

    return drop


def _extent(flat: FlatParameters, table: WheelProfileTable | None) -> tuple[float, float]:
    if table is None:
        return -0.5 * flat.length, 0.5 * flat.length
    return float(table.distance[0]), float(table.distance[-1])


def _depth(flat: FlatParameters, radius: float) -> float:
    return flat.length**2 / (8.0 * radius) if flat.shape == "chord" else flat.depth
