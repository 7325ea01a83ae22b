"""Results read back from files."""

from __future__ import annotations

from typing import TYPE_CHECKING

import xarray as xr

from .errors import InputError

if TYPE_CHECKING:
    from pathlib import Path


def read_result(path: Path) -> xr.Dataset:
    """Read the result that `output.write_dataset` wrote as NetCDF.

    Raises
    ------
    InputError
        For a file that is missing or no NetCDF-4 file.
    """
    if not path.is_file():
        raise InputError(f"there is no file {path}: check the path")
    try:
        with xr.open_dataset(path, engine="h5netcdf", decode_times=False) as stored:
            return stored.load()
    except (OSError, ValueError, KeyError) as error:
        raise InputError(
            f"{path} cannot be read as a NetCDF-4 file: name what railcosim run --output FILE.nc "
            "wrote"
        ) from error
