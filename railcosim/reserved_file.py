"""A file whose room on the disk is taken before it is written."""

from __future__ import annotations

import io
import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

    from _typeshed import ReadableBuffer


class ReservedFile(io.FileIO):
    """New file for HDF5, which ends the process when a write fails: none does within the room.

    Parameters
    ----------
    path : Path
        Where it is written.
    room : int
        Bytes to reserve; what is not used is given back.

    Raises
    ------
    OSError
        When there is not so much room.
    """

    def __init__(self, path: Path, room: int) -> None:
        super().__init__(path, "w+b")
        self._size = 0
        try:
            os.posix_fallocate(self.fileno(), 0, room)
        except OSError:
            self.close()
            raise

    def write(self, data: ReadableBuffer, /) -> int:
        """Write all of `data` and return its length."""
        left = memoryview(data).cast("B")
        size = len(left)
        while left:
            left = left[super().write(left) or 0 :]
        self._size = max(self._size, self.tell())
        return size

    def seek(self, offset: int, whence: int = os.SEEK_SET, /) -> int:
        """Move to a place; the end is where writing came to, whatever is reserved."""
        if whence == os.SEEK_END:
            return super().seek(self._size + offset)
        return super().seek(offset, whence)

    def truncate(self, size: int | None = None, /) -> int:
        """Remember the size of the file: it keeps its room until it is closed."""
        self._size = self.tell() if size is None else size
        return self._size

    def close(self) -> None:
        """Give back the room that was not used."""
        if not self.closed:
            super().truncate(self._size)
        super().close()
