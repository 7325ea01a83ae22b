"""Results from files: NetCDF, CSV and Parquet, of this project and of other tools."""

from __future__ import annotations

import csv
import importlib.util
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import xarray as xr

from ..errors import InputError
from ..result_file import check_file, read_netcdf, unreadable
from .recording import Recording, from_array, from_columns, from_dataset

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

Source: TypeAlias = "Recording | xr.Dataset | NDArray[np.void] | str | Path"
"""What can be compared."""

SEPARATORS = ",;\t"
"""What may stand between the columns of a CSV file."""

REMEDY = "check what made it"
"""What to do about a file that cannot be read."""


def record(source: Source, name: str = "the result") -> Recording:
    """Turn a result into a recording.

    Parameters
    ----------
    source : Recording, xarray.Dataset, structured ndarray, str or Path
        Result, or the file that holds it: .nc, .csv or .parquet.
    name : str
        What messages call a result that is no file.

    Raises
    ------
    InputError
        For a file that cannot be read or has no series over time.
    """
    if isinstance(source, Recording):
        return source
    if isinstance(source, xr.Dataset):
        return from_dataset(source, name)
    if isinstance(source, np.ndarray):
        return from_array(source, name)
    if not isinstance(source, (str, Path)):
        raise InputError(
            f"{name} is a {type(source).__name__} but must be an xarray.Dataset, a structured "
            "array or the path of a file: convert it"
        )
    return read_recording(Path(source))


def read_recording(path: Path) -> Recording:
    """Read a file.

    Raises
    ------
    InputError
        For a file that cannot be read or has no series over time.
    """
    readers: dict[str, Callable[[Path], Recording]] = {
        ".nc": _read_netcdf,
        ".csv": _read_csv,
        ".parquet": _read_parquet,
    }
    if path.suffix.lower() not in readers:
        raise InputError(
            f"{path} ends with {path.suffix!r} but must end with one of {', '.join(readers)}: "
            "convert it"
        )
    check_file(path)
    try:
        return readers[path.suffix.lower()](path)
    except InputError:
        raise
    except (OSError, ValueError, KeyError) as error:
        raise unreadable(path, f"a {path.suffix} file", error, REMEDY) from error


def _read_netcdf(path: Path) -> Recording:
    return from_dataset(read_netcdf(path, REMEDY), str(path))


def _read_csv(path: Path) -> Recording:
    """Read a table with a line of names; columns of nothing but 0 and 1 are taken for truths."""
    import pandas as pd  # noqa: PLC0415 - takes half a second to import, only tables need it

    with path.open(encoding="utf-8-sig", newline="") as file:
        heading = file.readline()
    separator = max(SEPARATORS, key=heading.count)
    names = next(csv.reader([heading], delimiter=separator), [])
    if names and not names[-1].strip():
        names.pop()  # some tools end every line with a separator
    table = pd.read_csv(
        path,
        sep=separator,
        header=None,
        skiprows=1,
        encoding="utf-8-sig",
        low_memory=False,
    )
    if table.shape[1] < len(names):
        raise InputError(
            f"{path} names {len(names)} columns but has {table.shape[1]}: check what made it"
        )
    arrays = (table[k].to_numpy() for k in range(len(names)))
    labelled = zip((name.strip() for name in names), arrays, strict=True)
    return from_columns(str(path), ((name, _typed(values)) for name, values in labelled))


def _typed(values: NDArray[Any]) -> NDArray[np.generic]:
    """Take whole numbers for truths or else for numbers, since a file of texts has no types."""
    if values.dtype.kind in "iu":
        return values.astype(bool if np.isin(values, (0, 1)).all() else float)
    return values


def _read_parquet(path: Path) -> Recording:
    if importlib.util.find_spec("pyarrow") is None:
        raise InputError(
            f"{path} needs the library pyarrow: pip install 'railcosim[parquet]', or compare a "
            ".nc or .csv file"
        )
    import pyarrow.parquet as pq  # noqa: PLC0415 - an optional library, looked for above

    table = pq.read_table(path)
    metadata = {
        key.decode(): value.decode(errors="replace")
        for key, value in (table.schema.metadata or {}).items()
        if key not in {b"ARROW:schema", b"pandas"}
    }
    arrays = zip(table.column_names, table.columns, strict=True)
    return from_columns(str(path), ((name, column.to_numpy()) for name, column in arrays), metadata)
