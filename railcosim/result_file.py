"""Results read back from files."""

from __future__ import annotations

from typing import TYPE_CHECKING

import xarray as xr

from .errors import InputError
from .signals import SIGNALS

if TYPE_CHECKING:
    from pathlib import Path


def read_passage(path: Path) -> xr.Dataset:
    """Read the result of a passage, which `output.write_dataset` wrote as NetCDF.

    Raises
    ------
    InputError
        For a file that cannot be read or holds something else.
    """
    if not path.is_file():
        raise InputError(f"there is no file {path}: check the path")
    try:
        with xr.open_dataset(path, engine="h5netcdf", decode_times=False) as stored:
            passage = stored.load()
    except (OSError, ValueError, KeyError) as error:
        reason = (getattr(error, "strerror", None) or str(error) or "unknown").splitlines()[0]
        raise InputError(
            f"{path} cannot be read as a result ({reason}): give a .nc file of railcosim run"
        ) from error
    missing = [signal.name for signal in SIGNALS if signal.name not in passage]
    if missing or "scenario" not in passage.attrs:
        raise InputError(
            f"{path} is not the result of a passage (it has no "
            f"{missing[0] if missing else 'scenario'}): give a .nc file of railcosim run"
        )
    return passage
