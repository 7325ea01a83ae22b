"""What is compared: the series of a result by name, whatever made it."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ..errors import InputError
from ..table import columns

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    import xarray as xr
    from numpy.typing import NDArray

FEWEST_TIMES = 2
"""Times that make a signal."""

LABEL = re.compile(r"(?P<name>.*?)(?: \[(?P<unit>[^\[\]]*)\])?", re.DOTALL)
"""Heading of a column: ``name [unit]``, or a name alone."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Series:
    """One signal as it was recorded.

    Attributes
    ----------
    values : ndarray, shape (n,)
        Samples; of a Boolean or whole-number type if the signal holds between them.
    unit : str
        Its unit; empty if none is known.
    """

    values: NDArray[np.generic]
    unit: str = ""

    @property
    def held(self) -> bool:
        """Whether the signal holds between its samples."""
        return self.values.dtype.kind in "biu"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Recording:
    """The series of a result.

    Attributes
    ----------
    name : str
        What messages call it.
    times : ndarray, shape (n,)
        Times [s] that do not decrease; one that stands twice is a jump.
    series : mapping of str to Series
        Every signal of shape (n,) by name.
    facts : mapping of str to str
        Attributes and numbers that are no series.
    left_out : tuple of str
        Columns that hold no numbers.

    Raises
    ------
    InputError
        For fewer than two times, times that decrease or are no numbers.
    """

    name: str
    times: NDArray[np.float64]
    series: Mapping[str, Series]
    facts: Mapping[str, str] = field(default_factory=dict)
    left_out: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        wrong = np.flatnonzero(~np.isfinite(self.times))
        if wrong.size:
            raise InputError(
                f"{self.name}: time number {wrong[0] + 1} is {self.times[wrong[0]]} but must be a "
                "finite number of seconds: repair the file"
            )
        back = np.flatnonzero(np.diff(self.times) < 0.0)
        if back.size:
            k = int(back[0])
            raise InputError(
                f"{self.name}: time goes back from {self.times[k]:.9g} s to "
                f"{self.times[k + 1]:.9g} s but must not decrease: sort the rows or take one run"
            )
        if self.times.size < FEWEST_TIMES or self.times[0] == self.times[-1]:
            raise InputError(
                f"{self.name} has {self.times.size} times but needs two different ones at least: "
                "compare a longer run"
            )


def from_columns(
    name: str,
    labelled: Iterable[tuple[str, NDArray[np.generic]]],
    facts: Mapping[str, str] | None = None,
) -> Recording:
    """Make a recording of columns.

    Parameters
    ----------
    name : str
        What messages call it.
    labelled : iterable of (str, ndarray)
        Columns with their headings ``name`` or ``name [unit]``. One is called time, in whatever
        letters; a column may have more dimensions, whose elements become signals ``name[k,l]``
        from 1.
    facts : mapping of str to str, optional
        Attributes.

    Raises
    ------
    InputError
        For a missing time or a name that stands twice.
    """
    series: dict[str, Series] = {}
    left_out: list[str] = []
    for label, array in labelled:
        for heading, values in _elements(label, array):
            key, unit = split_label(heading)
            if key in series:
                raise InputError(f"{name} has two signals {key}: give one of them another name")
            if values.dtype.kind not in "biuf":
                left_out.append(key)
                continue
            series[key] = Series(values=values, unit=unit)
    times = [key for key in series if key.lower() == "time"]
    if len(times) != 1:
        raise InputError(
            f"{name} has {len(times) or 'no'} signals called time but must have one: rename the "
            f"right one of {', '.join(list(series)[:8]) or 'its columns'}"
        )
    return Recording(
        name=name,
        times=series.pop(times[0]).values.astype(float),
        series=series,
        facts=facts or {},
        left_out=tuple(left_out),
    )


def from_dataset(dataset: xr.Dataset, name: str = "the result") -> Recording:
    """Make a recording of the variables over the dimension ``time``.

    Parameters
    ----------
    dataset : xarray.Dataset
        Result of a passage, of a co-simulation or of anything else.
    name : str
        What messages call it.

    Raises
    ------
    InputError
        For a dataset without a dimension ``time``.
    """
    if "time" not in dataset.sizes or "time" not in dataset.variables:
        raise InputError(
            f"{name} has the dimensions {', '.join(map(str, dataset.sizes)) or '-'} but needs one "
            "called time, with its values: rename it"
        )
    scalars = {
        str(key): str(item.to_numpy()) for key, item in dataset.variables.items() if not item.dims
    }
    attributes = {str(key): str(value) for key, value in dataset.attrs.items()}
    labelled = ((column.label, column.values) for column in columns(dataset))
    return from_columns(name, labelled, scalars | attributes)


def from_array(array: NDArray[np.void], name: str = "the result") -> Recording:
    """Make a recording of a structured array, as fmpy's ``simulate_fmu`` returns it.

    Raises
    ------
    InputError
        For an array without named columns.
    """
    if array.dtype.names is None:
        raise InputError(
            f"{name} is an array of {array.dtype} but must have named columns, time among them: "
            "give it as fmpy's simulate_fmu returns it"
        )
    return from_columns(name, ((column, array[column]) for column in array.dtype.names))


def split_label(label: str) -> tuple[str, str]:
    """Split ``name [unit]``.

    Returns
    -------
    tuple of str
        Name and unit, the latter empty where there is none or it is 1. NetCDF files have no
        slashes in names and hold bars in their place: a bar is read as a slash.
    """
    found = LABEL.fullmatch(label)
    assert found is not None  # it matches anything
    unit = found["unit"] or ""
    return found["name"].replace("|", "/"), "" if unit == "1" else unit


def _elements(label: str, array: NDArray[np.generic]) -> Iterator[tuple[str, NDArray[np.generic]]]:
    """Yield the column itself, or every element of a column of arrays."""
    if array.ndim == 1:
        yield label, array
        return
    for place in np.ndindex(array.shape[1:]):
        key = ",".join(str(k + 1) for k in place)
        yield f"{label}[{key}]", array[(slice(None), *place)]
