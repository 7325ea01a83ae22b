"""The track model from the parameters of an FMU."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from functools import lru_cache
from typing import Any

from track_fmu.assembly import assemble
from track_fmu.parameters import TrackParameters
from track_fmu.reduction import ReducedTrack, reduce_track
from track_fmu.track_model import TrackModel, TrackOptions

from .basis_cache import cached_basis
from .track_laws import make_laws


def make_track(
    parameters: Mapping[str, Any], *, bays: int, elements_per_bay: int, wheels: int, gauges: int
) -> TrackModel:
    """Track of given size and parameters; its modal basis comes from the cache if it is there.

    Raises
    ------
    ValueError
        If a parameter is wrong.
    """
    names = {field.name for field in fields(TrackParameters)}
    track = TrackParameters(
        bays=bays,
        elements_per_bay=elements_per_bay,
        **{name: value for name, value in parameters.items() if name in names},
    )
    options = TrackOptions(
        wheels=wheels,
        supports_per_wheel=parameters["supports_per_wheel"],
        initial_speed=parameters["initial_speed"],
        endless=parameters["endless"],
        gauges=tuple(parameters[f"gauge[{k}].position"] for k in range(1, gauges + 1)),
    )
    reduced = _reduced_track(track, parameters["mode_pairs"], parameters["residual_flexibility"])
    ballast, pad = make_laws(track, parameters)
    return TrackModel(reduced, options, ballast=ballast, pad=pad)


@lru_cache(maxsize=4)
def _reduced_track(
    parameters: TrackParameters, mode_pairs: int, residual_flexibility: bool
) -> ReducedTrack:
    """Reduced track; instances with the same parameters share it, none changes it."""
    matrices = assemble(parameters)
    basis = cached_basis(parameters, matrices, mode_pairs=mode_pairs)
    return reduce_track(parameters, matrices, basis, residual_flexibility=residual_flexibility)
