"""Which supports are treated as state-dependent: those nearest to the wheels."""

from __future__ import annotations

from .beam_element import FloatArray
from .parameters import TrackParameters


def nearest_supports(
    parameters: TrackParameters, positions: FloatArray, count: int
) -> tuple[int, ...]:
    """Numbers (from 0) of the ``count`` supports nearest to each wheel, ascending, no repeats.

    Parameters
    ----------
    parameters : TrackParameters
        Support i stands at ``(i + 1) * sleeper_spacing``.
    positions : (wheels,) float array
        Of the wheels [m].
    count : int
        Supports per wheel; all of them if the track has no more.
    """
    if count >= parameters.supports:
        return tuple(range(parameters.supports))
    chosen: set[int] = set()
    for position in positions:
        # the nearest `count` of an equidistant row are consecutive: round the first one
        first = round(position / parameters.sleeper_spacing - 1.0 - 0.5 * (count - 1))
        first = min(max(first, 0), parameters.supports - count)
        chosen.update(range(first, first + count))
    return tuple(sorted(chosen))
