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


def columns(passage: xr.Dataset) -> Iterator[Column]:
    """Yield every series over time, the time itself first; without time, over the first dimension.

    Parameters
    ----------
    passage : xarray.Dataset
        Result of a passage, of another co-simulation, or of a study over frequency and the like.

    Yields
    ------
    Column
        In the order of the dataset's variables.
    """
    rows = "time" if "time" in passage.dims else next(iter(passage.dims))
    along = [name for name, axis in passage.coords.items() if axis.dims == (rows,)]
    names = dict.fromkeys([rows, *along, *passage.data_vars])
    for name in names:
        variable = passage[name]
        if variable.dims == (rows,):
            yield _column(variable, str(name))
        elif variable.dims[:1] == (rows,):
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
