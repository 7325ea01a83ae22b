"""The time series of a result as plain columns."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator

    import numpy as np
    import xarray as xr
    from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Column:
    """One time series.

    Attributes
    ----------
    label : str
        ``variable [unit]``, or ``variable[k] [unit]`` for the k-th wheel, sleeper or gauge;
        without the bracket where there is no unit.
    values : ndarray, shape (times,)
        The series.
    attributes : dict of str to str
        Units, long name and sign.
    """

    label: str
    values: NDArray[np.generic]
    attributes: dict[str, str]


def columns(passage: xr.Dataset) -> Iterator[Column]:
    """Yield every series over time, the time itself first.

    Parameters
    ----------
    passage : xarray.Dataset
        Result of a passage or of another co-simulation.

    Yields
    ------
    Column
        In the order of the dataset's variables.
    """
    over_time = [name for name, axis in passage.coords.items() if axis.dims == ("time",)]
    names = dict.fromkeys(["time", *over_time, *passage.data_vars])
    for name in names:
        variable = passage[name]
        if variable.dims == ("time",):
            yield _column(variable, str(name))
        elif variable.dims[:1] == ("time",):
            others = variable.dims[1:]
            for place in product(*(range(variable.sizes[dim]) for dim in others)):
                one = dict(zip(others, place, strict=True))
                key = ",".join(str(passage[dim].to_numpy()[k]) for dim, k in one.items())
                yield _column(variable.isel(one), f"{name}[{key}]")


def _column(variable: xr.DataArray, name: str) -> Column:
    attributes: dict[str, Any] = variable.attrs
    return Column(
        label=f"{name} [{attributes['units']}]" if attributes.get("units") else name,
        values=variable.to_numpy(),
        attributes={key: str(value) for key, value in attributes.items()},
    )
