"""Recordings kept as baselines."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from ..errors import InputError
from ..output import write_dataset
from .tolerances import matches

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from .recording import Recording


def restrict(recording: Recording, patterns: Sequence[str]) -> Recording:
    """Return the signals of a recording that a pattern matches, or all of them without patterns.

    Raises
    ------
    InputError
        For a pattern that matches none.
    """
    if not patterns:
        return recording
    for pattern in patterns:
        if not any(matches(name, pattern) for name in recording.series):
            raise InputError(
                f"no signal of {recording.name} is of the pattern {pattern!r}: it has "
                f"{', '.join(list(recording.series)[:8])}"
            )
    chosen = {
        name: series
        for name, series in recording.series.items()
        if any(matches(name, pattern) for pattern in patterns)
    }
    return replace(recording, series=chosen, left_out=())


def check_finite(recording: Recording) -> None:
    """Refuse what no result could ever agree with.

    Raises
    ------
    InputError
        For a signal with values that are no finite numbers.
    """
    for name, series in recording.series.items():
        if not np.isfinite(series.values).all():
            raise InputError(
                f"the signal {name} of {recording.name} has values that are no finite numbers and "
                "makes no baseline: repair it or choose others with signals=[...]"
            )


def write_baseline(recording: Recording, path: Path) -> None:
    """Write a recording as NetCDF-4, compressed, in one piece.

    Parameters
    ----------
    recording : Recording
        What is kept: its series and its facts.
    path : Path
        File that ends with .nc.

    Raises
    ------
    RunError
        Where it cannot be written.
    """
    series = {
        name: xr.Variable(
            "time",
            item.values,
            {"units": item.unit or "1"},
            {"zlib": True, "shuffle": True},
        )
        for name, item in recording.series.items()
    }
    time = xr.Variable("time", recording.times, {"units": "s"}, {"zlib": True, "shuffle": True})
    write_dataset(xr.Dataset(series, coords={"time": time}, attrs=dict(recording.facts)), path)
