"""What supports have of their own, from the parameters of a track FMU or the table they name."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from track_fmu.parameters import TrackParameters
from track_fmu.support_factors import SupportFactors

from .support_table import read_support_table

SUPPORT_PARAMETERS = (
    ("pad_stiffness_factor", 1.0, "1", "Factor on the stiffness of the rail pad of support {}"),
    ("pad_damping_factor", 1.0, "1", "Factor on the damping of the rail pad of support {}"),
    ("ballast_stiffness_factor", 1.0, "1", "Factor on the ballast stiffness under support {}"),
    ("ballast_damping_factor", 1.0, "1", "Factor on the ballast damping under support {}"),
    ("gap", 0.0, "m", "Gap between the unloaded sleeper of support {} and its ballast"),
    ("fastened", True, "", "Whether the rail is fastened on support {}; false: it can lift off"),
)
"""Name, start value, unit and description of what every support has of its own."""

PROPERTIES = {name: float(start) for name, start, _, _ in SUPPORT_PARAMETERS}
"""Nominal values by name, which are the columns of tables of supports, too."""


def support_factors(track: TrackParameters, parameters: Mapping[str, Any]) -> SupportFactors:
    """What the supports have of their own; nominal where nothing is given.

    Of an ordinary track those that it has; of an endless one those from the first one on, as far
    as the parameters or the table go.

    Raises
    ------
    ValueError
        If the table cannot be used or parameters of single supports are given beside it.
    """
    path, repeat = parameters.get("supports", ""), bool(parameters.get("supports_repeat", False))
    endless = bool(parameters.get("endless", False))
    count = track.supports
    given = {
        name: np.array(
            [float(parameters.get(f"support[{i + 1}].{name}", nominal)) for i in range(count)]
        )
        for name, nominal in PROPERTIES.items()
    }
    if not path:
        if repeat:
            raise ValueError(
                "track: supports_repeat is true, but supports names no table that could be repeated"
            )
        return make_factors(given)
    if any((values != PROPERTIES[name]).any() for name, values in given.items()):
        raise ValueError(
            f"track: supports names the table {path}, but support[i].* are given, too; leave one "
            "of the two out"
        )
    columns = read_columns(path, spacing=track.sleeper_spacing, supports=None if endless else count)
    factors = make_factors(columns, repeat=repeat)
    return factors if endless else factors.window(0, count)


def read_columns(path: str, *, spacing: float, supports: int | None) -> dict[str, Any]:
    """All properties of the supports of a table, (last number,) each, nominal in its gaps.

    Parameters
    ----------
    path, spacing, supports
        See `read_support_table`.

    Raises
    ------
    ValueError
        If the table cannot be used.
    """
    rows = read_support_table(path, PROPERTIES, spacing=spacing, supports=supports)
    known = max(rows, default=0) + 1
    columns = {name: np.full(known, nominal) for name, nominal in PROPERTIES.items()}
    for support, own in rows.items():
        for name, value in own.items():
            columns[name][support] = value
    return columns


def make_factors(columns: Mapping[str, Any], *, repeat: bool = False) -> SupportFactors:
    """Factors from the columns of a table, by the names of `PROPERTIES`.

    Raises
    ------
    ValueError
        For values that no support has.
    """
    return SupportFactors(
        **{name.removesuffix("_factor"): values for name, values in columns.items()}, repeat=repeat
    )
