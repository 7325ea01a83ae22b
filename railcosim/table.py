"""The series of a result, over time or over what it is about, as plain columns."""

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
    """One series.

    Attributes
    ----------
    label : str
        ``variable [unit]``, or ``variable[k] [unit]`` for the k-th wheel, sleeper or gauge;
        without the bracket where there is no unit.
    values : ndarray, shape (rows,)
        The series.
    attributes : dict of str to str
        Units, long name and sign.
    """

    label: str
    values: NDArray[np.generic]
    attributes: dict[str, str]


def columns(result: xr.Dataset, along: str | None = None) -> Iterator[Column]:
    """Yield every series over time, or along another dimension, that dimension itself first.

    Parameters
    ----------
    result : xarray.Dataset
        Result of a passage, of another co-simulation, or of a study over frequency and the like.
    along : str, optional
        Dimension of the rows, time or else the first one without; what does not have it as its
        first dimension is left out.

    Yields
    ------
    Column
        In the order of the dataset's variables.
    """
    if along is None:
        along = "time" if "time" in result.dims else str(next(iter(result.dims)))
    over_rows = [name for name, axis in result.coords.items() if axis.dims == (along,)]
    names = dict.fromkeys([along, *over_rows, *result.data_vars])
    for name in names:
        variable = result[name]
        if variable.dims == (along,):
            yield _column(variable, str(name))
        elif variable.dims[:1] == (along,):
            others = variable.dims[1:]
            for place in product(*(range(variable.sizes[dim]) for dim in others)):
                one = dict(zip(others, place, strict=True))
                key = ",".join(str(result[dim].to_numpy()[k]) for dim, k in one.items())
                yield _column(variable.isel(one), f"{name}[{key}]")


def _column(variable: xr.DataArray, name: str) -> Column:
    attributes: dict[str, Any] = variable.attrs
    return Column(
        label=f"{name} [{attributes['units']}]" if attributes.get("units") else name,
        values=variable.to_numpy(),
        attributes={key: str(value) for key, value in attributes.items()},
    )
