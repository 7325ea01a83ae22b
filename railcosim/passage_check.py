"""Whether a dataset is the result of a passage, before anything is worked out from it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .dataset import count
from .errors import InputError
from .run_record import ATTEMPT_COLUMNS
from .scenario_file import from_toml
from .signals import SIGNALS
from .summary import CAUSES, is_thinned

if TYPE_CHECKING:
    from collections.abc import Mapping

    import xarray as xr

    from .signals import Dimension

TEXTS = ("scenario", "fmus", "contact", "stop_reason", "warnings", "unreliable")
"""Attributes of a result that are texts."""

NUMBERS = (
    "complete",
    "simulated_time",
    "wall_time",
    "iterations",
    "steps_accepted",
    *(f"steps_rejected_{cause}" for cause in CAUSES),
)
"""Those that are numbers."""

CONSTANTS = ("flat_wheel", "flat_position", "static_wheel_load")
"""Variables that are one number."""

SERIES: Mapping[str, tuple[str, ...]] = {
    "time": ("time",),
    "distance": ("time",),
    "sleeper_position": ("sleeper",),
    "gauge_position": ("gauge",),
    **{signal.name: ("time", signal.dim) for signal in SIGNALS},
    **dict.fromkeys(CONSTANTS, ()),
    **{f"attempt_{name}": ("attempt",) for name in ATTEMPT_COLUMNS},
}
"""Variables of a result and their dimensions."""

MAY_BE_INFINITE = "attempt_"
"""How the names of variables begin that need not be finite: norms of attempts that failed."""

KIND = {"attempt_cause": "SUO"}
"""Kinds of the arrays that are not numbers."""


def check_passage(passage: xr.Dataset, name: str) -> None:
    """See that a dataset is the result of a passage, whole and of one piece.

    Parameters
    ----------
    passage : xarray.Dataset
        What should be one, complete or ended early.
    name : str
        What messages call it.

    Raises
    ------
    InputError
        For histories that have been thinned, for anything missing, of another shape or kind, not
        finite, or at odds with the scenario.
    """
    if is_thinned(passage):
        raise InputError(
            f"{name} has only {passage.attrs['kept_signals']} every "
            f"{passage.attrs['kept_spacing']:g} m but every history at every step is needed: run "
            "its scenario without [keep]"
        )
    wrong = _wrong_attribute(passage.attrs) or _wrong_variable(passage)
    if wrong is None:
        try:
            scenario = from_toml(passage.attrs["scenario"])
        except InputError as error:
            wrong = f"its scenario cannot be read: {error}"
        else:
            wrong = _wrong_size(passage, count(scenario)) or _wrong_time(passage)
    if wrong is not None:
        raise InputError(
            f"{name} is not the result of a passage ({wrong}): give what railcosim run --output "
            "FILE.nc wrote"
        )


def _wrong_attribute(attributes: Mapping[Any, Any]) -> str | None:
    for key in (*TEXTS, *NUMBERS):
        if key not in attributes:
            return f"it has no {key}"
        kinds = str if key in TEXTS else (int, float, np.number)
        if not isinstance(attributes[key], kinds):
            return f"its {key} is {attributes[key]!r:.40}"
    if attributes["contact"] not in {"vehicle", "track"}:
        return f"its contact is {attributes['contact']!r:.40}"
    return None


def _wrong_variable(passage: xr.Dataset) -> str | None:
    for name, dims in SERIES.items():
        if name not in passage.variables:
            return f"it has no {name}"
        variable = passage[name]
        if set(variable.dims) != set(dims):
            return f"its {name} has the dimensions {', '.join(map(str, variable.dims)) or '-'}"
        if variable.dtype.kind not in KIND.get(name, "biuf"):
            return f"its {name} has values of the type {variable.dtype}"
        if name.startswith(MAY_BE_INFINITE):
            continue
        if not np.isfinite(variable.to_numpy()).all():
            return f"its {name} has values that are not finite"
    return None


def _wrong_size(passage: xr.Dataset, numbers: Mapping[Dimension, int]) -> str | None:
    for dim, number in numbers.items():
        expected = np.arange(1, number + 1)
        if dim not in passage.variables or not np.array_equal(passage[dim], expected):
            return f"it has {passage.sizes[dim]} of the {number} {dim}s of its scenario"
    return None


def _wrong_time(passage: xr.Dataset) -> str | None:
    times = passage["time"].to_numpy()
    if times.size == 0:
        return "it has no accepted time"
    if (np.diff(times) <= 0.0).any():
        return "its times do not increase"
    return None
