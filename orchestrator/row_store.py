"""Rows of one type in bounded memory: many of them wait in a file without a name."""

import os
import tempfile
import weakref
from typing import IO

import numpy as np
from numpy.typing import NDArray

from .errors import RunError

memory_limit = 16 * 2**20
"""Bytes of rows that stay in memory; with more than that all of them move to a file."""


class RowStore:
    """A table that only grows.

    Parameters
    ----------
    row_type : numpy.dtype
        Fields of a row.
    limit : int, optional
        Bytes that stay in memory; `memory_limit` by default.
    """

    def __init__(self, row_type: np.dtype[np.void], *, limit: int | None = None) -> None:
        self._row_type = row_type
        self._limit = memory_limit if limit is None else limit
        self._count = 0
        self._chunks: list[NDArray[np.void]] = []
        self._file: IO[bytes] | None = None
        self._mapped: NDArray[np.void] | None = None

    def __len__(self) -> int:
        """Return the number of rows."""
        return self._count

    def extend(self, rows: NDArray[np.void]) -> None:
        """Add a copy of `rows`, shape (n,).

        Raises
        ------
        RunError
            When there is no room for them on the disk; the rows before are still there.
        """
        if self._file is None and (self._count + len(rows)) * self._row_type.itemsize > self._limit:
            self._move_to_file()
        if self._file is None:
            self._chunks.append(rows.copy())
        else:
            self._write(self._file, rows, self._count)
        self._count += len(rows)

    def as_array(self) -> NDArray[np.void]:
        """Return all rows, shape (n_rows,), read-only where they are in a file."""
        if self._file is not None:
            if self._mapped is None or len(self._mapped) != self._count:
                self._mapped = np.memmap(self._file, self._row_type, "r", shape=(self._count,))
            return self._mapped
        if len(self._chunks) != 1:
            self._chunks = [np.concatenate([np.empty(0, self._row_type), *self._chunks])]
        return self._chunks[0]

    def _move_to_file(self) -> None:
        rows = self.as_array()
        try:
            file = tempfile.TemporaryFile(buffering=0)  # noqa: SIM115 - as long as the store
        except OSError as error:
            raise self._failure(error) from error
        weakref.finalize(self, file.close)
        self._write(file, rows, 0)
        self._file = file
        self._chunks.clear()

    def _write(self, file: IO[bytes], rows: NDArray[np.void], place: int) -> None:
        # The place is given: what a full disk took of a write that failed is not there.
        left = memoryview(rows.tobytes())
        end = place * self._row_type.itemsize
        try:
            while left:
                written = os.pwrite(file.fileno(), left, end)
                left, end = left[written:], end + written
        except OSError as error:
            raise self._failure(error) from error

    def _failure(self, error: OSError) -> RunError:
        return RunError(
            f"The records of the run, {self._count} rows of {self._row_type.itemsize} bytes so "
            f"far, have no more room in {tempfile.gettempdir()} ({error.strerror}); free some "
            "space there, or name a larger folder in the environment variable TMPDIR."
        )
