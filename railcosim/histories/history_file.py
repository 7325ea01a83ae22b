"""A NetCDF file whose series over time are written while they come about."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import h5netcdf

from ..errors import RunError
from ..output import OVERHEAD
from ..reserved_file import ReservedFile

if TYPE_CHECKING:
    from collections.abc import Hashable, Mapping
    from pathlib import Path

    import numpy as np
    import xarray as xr
    from numpy.typing import NDArray

CHUNK = 2**16
"""Bytes of a variable that the file keeps together."""


class HistoryFile:
    """Appends along the dimension ``time``; the room is taken first, as HDF5 ends the process else.

    Parameters
    ----------
    path : Path
        New file.
    template : xarray.Dataset
        Every variable over ``time``, without points, and what else is known from the start.
    points : int
        Most points that will come.
    room : int
        Bytes that `finish` will need.

    Raises
    ------
    RunError
        When there is not so much room.
    """

    def __init__(self, path: Path, template: xr.Dataset, *, points: int, room: int) -> None:
        series = {name: v for name, v in template.variables.items() if v.dims[:1] == ("time",)}
        rows = {name: v.dtype.itemsize * math.prod(v.shape[1:]) for name, v in series.items()}
        chunks = {name: max(1, CHUNK // size) for name, size in rows.items()}
        needed = sum((points + chunks[name]) * size for name, size in rows.items())
        needed = OVERHEAD + (template.nbytes + room + needed) * 5 // 4
        self.is_open = True
        self._length = 0
        try:
            self._file = ReservedFile(path, needed)
        except OSError as error:
            raise RunError(
                f"the kept histories, {needed / 1e6:.0f} MB, have no room in {path.parent} "
                f"({error.strerror}): free some space, or keep less in [keep]"
            ) from error
        # xarray would write it too, but not in a worker of dask, where it pickles the file
        self._netcdf = h5netcdf.File(self._file, "w")
        self._netcdf.dimensions = dict(template.sizes) | {"time": None}
        self._put(template, chunks)
        named = {
            axis for item in template.data_vars.values() for axis in _positions(template, item)
        }
        others = [str(name) for name in template.coords if name not in named | set(template.dims)]
        self._netcdf.attrs["coordinates"] = " ".join(others)

    def append(self, series: Mapping[str, NDArray[np.float64]]) -> None:
        """Write the next points.

        Parameters
        ----------
        series : mapping of str to ndarray, shape (n, ...)
            Every variable over ``time``.
        """
        start = self._length
        self._length += len(series["time"])
        self._netcdf.resize_dimension("time", self._length)
        for name, values in series.items():
            self._netcdf.variables[name][start : self._length] = values

    def finish(self, rest: xr.Dataset) -> None:
        """Write what is known at the end, and close the file.

        Parameters
        ----------
        rest : xarray.Dataset
            Variables that the template does not have, and the attributes of the whole.
        """
        for dim, size in rest.sizes.items():
            if dim not in self._netcdf.dimensions:
                self._netcdf.dimensions[dim] = size
        self._put(rest, {})
        self._netcdf.attrs.update(rest.attrs)
        self.close()

    def _put(self, part: xr.Dataset, chunks: Mapping[Hashable, int]) -> None:
        """Write variables that are not there yet, as the CF conventions have it."""
        for name, item in part.variables.items():
            if name in self._netcdf.variables:
                continue
            chunk = (chunks[name], *item.shape[1:]) if name in chunks else None
            written = self._netcdf.create_variable(
                name, item.dims, item.dtype, data=item.to_numpy(), chunks=chunk
            )
            written.attrs.update(item.attrs)
            axes = [] if name in part.coords else _positions(part, item)
            if axes:
                written.attrs["coordinates"] = " ".join(axes)

    def close(self) -> None:
        """Close the file; what has not been finished is of no use."""
        if self.is_open:
            self.is_open = False
            self._netcdf.close()
            self._file.close()


def _positions(part: xr.Dataset, item: xr.Variable | xr.DataArray) -> list[str]:
    """Name the coordinates of a variable beside those of its dimensions' own names."""
    return [
        str(name)
        for name, axis in part.coords.items()
        if name not in part.dims and set(axis.dims) <= set(item.dims)
    ]
