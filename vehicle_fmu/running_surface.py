"""The surface a wheel meets: the given displacement of the rail plus the drops of its own shape."""

import math

from .validation import FloatArray


def checked_rail_displacement(rail_displacement: FloatArray, wheels: int) -> list[float]:
    """Return the rail displacements as floats [m].

    Raises
    ------
    ValueError
        If their shape is not (wheels,) or one of them is NaN or infinite.
    """
    if rail_displacement.shape != (wheels,):
        raise ValueError(
            f"the rail displacement has shape {rail_displacement.shape}; {wheels} wheels need "
            f"{(wheels,)}"
        )
    rail: list[float] = rail_displacement.tolist()
    for i, u in enumerate(rail):
        if not math.isfinite(u):
            raise ValueError(
                f"the rail displacement under wheel {i + 1} is {u:g} m; it must be a finite number"
            )
    return rail


def surface_over_step(rail_start: float, rail_end: float, drops: list[float]) -> list[float]:
    """Return the level of the surface a wheel meets at equidistant times from start to end [m].

    The rail's displacement [m] goes on a straight line; `drops` [m] is what tread and railhead lie
    lower at each of these times. All positive downwards.
    """
    intervals = len(drops) - 1
    rise = (rail_end - rail_start) / intervals
    surface = [rail_start + k * rise + drop for k, drop in enumerate(drops)]
    surface[-1] = rail_end + drops[-1]
    return surface
