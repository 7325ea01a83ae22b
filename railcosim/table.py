"""The series of a result as plain columns."""

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
        ``variable [unit]``, or ``variable[k] [unit]`` for the k-th wheel, sleeper or gauge.
    values : ndarray, shape (rows,)
        The series.
    attributes : dict of str to str
        Units, long name and sign.
    """

    label: str
    values: NDArray[np.generic]
    attributes: dict[str, str]


def columns(result: xr.Dataset, along: str = "time") -> Iterator[Column]:
    """Yield every series over time, or along another dimension, that dimension itself first.

    Parameters
    ----------
    result : xarray.Dataset
        Result of a passage or of another co-simulation, or what was worked out from one.
    along : str
        Dimension of the rows; what does not have it as its first one is left out.

    Yields
    ------
    Column
        In the order of the dataset's variables.
    """
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
        label=f"{name} [{attributes['units']}]",
        values=variable.to_numpy(),
        attributes={key: str(value) for key, value in attributes.items()},
    )
