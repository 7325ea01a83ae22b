"""Results on disk: checked before the run, written in one piece after it."""

from __future__ import annotations

import csv
import importlib.util
import os
import tempfile
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .errors import InputError, RunError
from .mat_file import write_mat
from .reserved_file import ReservedFile
from .table import columns

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    import xarray as xr
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

DATA_SUFFIXES = (".nc", ".csv", ".parquet", ".mat")
"""Kinds of result file."""

TABLE_SUFFIXES = (".csv", ".parquet")
"""Those that hold one table."""

FIGURE_SUFFIXES = (".png", ".pdf", ".svg")
"""Kinds of figure file."""


ROWS_AT_ONCE = 4096
"""Rows of a table that are in memory together as Python numbers."""

REPLAY_SUFFIX = ".replay"
"""End of the name of a file that repeats how a run failed."""

OVERHEAD = 4 * 2**20
"""Room for what a NetCDF file holds besides its arrays [bytes]."""

TEMPORARY = ".railcosim-"
"""How the folder beside a result begins in which it is written."""


def check_writable(path: Path, *, option: str, suffixes: tuple[str, ...]) -> None:
    """Find out before a run whether its result can be written after it.

    Parameters
    ----------
    path : Path
        File to be written.
    option : str
        Command line option that gave it, for the message.
    suffixes : tuple of str
        Allowed endings.

    Raises
    ------
    InputError
        For another ending, a missing or read-only folder, a folder in the file's place, or a
        missing library.
    """
    if path.suffix.lower() not in suffixes:
        raise InputError(
            f"{option} {path} ends with {path.suffix!r} but must end with one of "
            f"{', '.join(suffixes)}: rename it"
        )
    try:
        is_folder, has_folder = path.is_dir(), path.parent.is_dir()
    except OSError as error:
        raise InputError(f"{option} {path} is no usable name ({error.strerror})") from error
    if is_folder:
        raise InputError(f"{option} {path} is a folder: name a file in it")
    if not has_folder:
        raise InputError(f"{option} {path} lies in a folder that does not exist: create it first")
    if path.suffix.lower() == ".parquet" and importlib.util.find_spec("pyarrow") is None:
        raise InputError(
            f"{option} {path} needs the library pyarrow: pip install 'railcosim[parquet]', or "
            "write a .nc or .csv file"
        )
    try:
        with tempfile.TemporaryDirectory(dir=path.parent, prefix=TEMPORARY) as folder:
            (Path(folder) / path.name).touch()  # a name may be too long for the file system
        writable = not path.exists() or os.access(path, os.W_OK)
    except OSError:
        writable = False
    if not writable:
        raise InputError(f"{option} {path} is not writable: choose another place")


def write_dataset(result: xr.Dataset, path: Path, *, along: str | None = None) -> None:
    """Write a result in one piece: everything as NetCDF-4 or MAT, or one table as CSV or Parquet.

    Parameters
    ----------
    result : xarray.Dataset
        Result of a passage or of another co-simulation, or what was worked out from one.
    path : Path
        File that ends with one of `DATA_SUFFIXES`.
    along : str, optional
        Dimension of the rows of a table; see `table.columns`.

    Raises
    ------
    RunError
        Where it cannot be written; what the file held before is still there then.
    """
    writers: dict[str, Callable[[xr.Dataset, Path], None]] = {
        ".nc": _write_netcdf,
        ".mat": write_mat,
        ".csv": partial(_write_csv, along=along),
        ".parquet": partial(_write_parquet, along=along),
    }
    with replacing(path) as temporary:
        writers[path.suffix.lower()](result, temporary)


def write_figure(figure: Figure, path: Path) -> None:
    """Write a figure in one piece, in the format that the file's ending names.

    Raises
    ------
    RunError
        Where it cannot be written.
    """
    with replacing(path) as temporary:
        figure.savefig(temporary, dpi=150)


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Yield a temporary file that takes the place of ``path`` if the block succeeds."""
    try:
        with tempfile.TemporaryDirectory(dir=path.parent, prefix=TEMPORARY) as folder:
            temporary = Path(folder) / path.name
            yield temporary
            temporary.replace(path)
    except OSError as error:
        raise RunError(
            f"{path} cannot be written: {error.strerror or 'the system refuses'}; free some space "
            "or choose "
            "another place"
        ) from error


def _write_netcdf(passage: xr.Dataset, path: Path) -> None:
    """Write everything; the room is taken first: HDF5 ends the process when the disk is full."""
    # HDF5 takes a slash for a group; names of FMU variables may have one.
    slashed = [str(name) for name in passage.data_vars if "/" in str(name)]
    renamed = passage.rename({name: name.replace("/", "|") for name in slashed})
    encoded = renamed.assign(
        {name: _encoded(item) for name, item in renamed.items() if item.dtype.kind == "U"}
    )
    with ReservedFile(path, OVERHEAD + encoded.nbytes * 5 // 4) as file:
        encoded.to_netcdf(file, engine="h5netcdf")


def _encoded(texts: xr.DataArray) -> xr.DataArray:
    """Encode ASCII texts at once, as xarray does one by one in six times the memory."""
    return texts.copy(data=texts.to_numpy().astype(np.bytes_)).assign_attrs(_Encoding="utf-8")


def _write_csv(result: xr.Dataset, path: Path, *, along: str | None) -> None:
    """Write one row per accepted time; the shortest digits that give the same number back."""
    series = list(columns(result, along))
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow([column.label for column in series])
        for start in range(0, len(series[0].values), ROWS_AT_ONCE):
            part = slice(start, start + ROWS_AT_ONCE)
            writer.writerows(zip(*(_plain(column.values[part]) for column in series), strict=True))


def _write_parquet(result: xr.Dataset, path: Path, *, along: str | None) -> None:
    """Write one row per accepted time; units, long names, signs and the scenario as metadata."""
    import pyarrow as pa  # noqa: PLC0415 - an optional library, looked for by `check_writable`
    import pyarrow.parquet as pq  # noqa: PLC0415 - likewise

    series = list(columns(result, along))
    schema = pa.schema(
        [
            pa.field(c.label, pa.from_numpy_dtype(c.values.dtype), metadata=c.attributes)
            for c in series
        ],
        metadata={key: str(value) for key, value in result.attrs.items()},
    )
    pq.write_table(pa.table([pa.array(c.values) for c in series], schema=schema), path)


def _plain(values: NDArray[np.generic]) -> list[float]:
    """Return Python numbers; a truth as 0 or 1."""
    numbers: list[float] = (values.astype(int) if values.dtype == bool else values).tolist()
    return numbers
