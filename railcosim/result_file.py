"""Results read back from NetCDF files."""

from __future__ import annotations

from typing import TYPE_CHECKING

import xarray as xr

from .errors import InputError
from .passage_check import check_passage

if TYPE_CHECKING:
    from pathlib import Path


def read_passage(path: Path) -> xr.Dataset:
    """Read the result of a passage, which `output.write_dataset` wrote as NetCDF.

    Raises
    ------
    InputError
        For a file that cannot be read or holds something else.
    """
    passage = read_netcdf(path, "give a .nc file of railcosim run")
    check_passage(passage, str(path))
    return passage


def read_netcdf(path: Path, remedy: str) -> xr.Dataset:
    """Read a whole NetCDF file into memory.

    Parameters
    ----------
    path : Path
        The file.
    remedy : str
        What to do about one that cannot be read, for the message.

    Raises
    ------
    InputError
        For a file that cannot be read.
    """
    check_file(path)
    try:
        with xr.open_dataset(path, engine="h5netcdf", decode_times=False) as stored:
            return stored.load()
    except (OSError, ValueError, KeyError, RuntimeError) as error:  # the last for damaged HDF5
        raise unreadable(path, "a NetCDF file", error, remedy) from error


def check_file(path: Path) -> None:
    """Find out whether there is a file.

    Raises
    ------
    InputError
        Where there is none.
    """
    try:
        there = path.is_file()
    except OSError as error:  # a name that is too long
        raise InputError(f"{str(path)!r:.100} is no usable name ({error.strerror})") from error
    if not there:
        raise InputError(
            f"{path} is a folder: name a file in it"
            if path.is_dir()
            else f"there is no file {path}: check the path"
        )


def unreadable(path: Path, kind: str, error: Exception, remedy: str) -> InputError:
    """Return the error that says in a sentence that a file cannot be read, why, and what to do."""
    reason = getattr(error, "strerror", None) or str(error) or type(error).__name__
    return InputError(f"{path} cannot be read as {kind} ({reason.splitlines()[0]}): {remedy}")
