"""The folder that keeps every case as it ends, under its content key.

A case is a JSON file with its numbers, or the reason why it failed, and a NumPy file with its
histories if there are any, which is written first. Both appear in one move, so that any number of
processes on any number of machines may write into the folder.
"""

from __future__ import annotations

import json
import shutil
import time
import zipfile
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..errors import InputError, RunError
from ..output import TEMPORARY, replacing

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from .case import Swept

MARK = "railcosim-store.json"
"""File that makes a folder a store."""

FORMAT = 1
"""Version of the files in a store."""

ABANDONED = 3600.0
"""Age from which on a temporary folder belongs to a process that was killed [s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Record:
    """What is kept of a case.

    Attributes
    ----------
    swept : mapping of str to value
        The swept keys, for whoever reads the file.
    numbers : mapping of str to float
        See `numbers.NUMBERS`; empty if it failed.
    failure : str
        Why it failed, in a sentence, or nothing.
    traceback : str
        Where it failed, if that was no foreseen failure.
    warnings : str
        What makes it doubtful, one sentence a line.
    fmu_guids : tuple of str
        The track's and the vehicle's FMU.
    wall_time : float
        How long it took [s].
    histories_size : int
        Bytes of the histories' file, 0 without.
    """

    swept: Mapping[str, Swept]
    numbers: Mapping[str, float]
    failure: str = ""
    traceback: str = ""
    warnings: str = ""
    fmu_guids: tuple[str, ...] = ()
    wall_time: float = 0.0
    histories_size: int = 0

    def timed(self, wall_time: float) -> Record:
        """Return the same record with the time that it took."""
        return replace(self, wall_time=wall_time)


@dataclass(frozen=True, slots=True)
class Store:
    """A folder of cases; see `open_store`.

    Attributes
    ----------
    folder : Path
        Where it is.
    """

    folder: Path

    def is_there(self) -> bool:
        """Tell whether the folder is a store, as seen from this machine."""
        return (self.folder / MARK).is_file()

    def keys(self) -> set[str]:
        """Return the keys of all cases."""
        found = {path.stem for path in self.folder.iterdir() if path.suffix == ".json"}
        return found - {Path(MARK).stem}

    def read(self, key: str) -> Record | None:
        """Return what is kept of a case; None if nothing is, or if it is damaged."""
        try:
            text = self._numbers(key).read_text(encoding="utf-8")
            record = Record(**json.loads(text))
            size = record.histories_size
            if size and self._histories(key).stat().st_size != size:
                return None
        except (OSError, ValueError, TypeError):  # missing, torn, or of another form
            return None
        return record

    def histories(self, key: str) -> dict[str, NDArray[np.float64]]:
        """Return the histories of a case by name.

        Raises
        ------
        RunError
            If they are damaged.
        """
        path = self._histories(key)
        try:
            with np.load(path, allow_pickle=False) as arrays:
                return dict(arrays)
        except (OSError, ValueError, KeyError, zipfile.BadZipFile) as error:
            raise RunError(f"{path} is damaged ({error}): delete it and start again") from error

    def write(
        self, key: str, record: Record, histories: Mapping[str, NDArray[np.float64]] | None = None
    ) -> None:
        """Keep a case in one move.

        Raises
        ------
        RunError
            Where it cannot be written.
        """
        size = 0
        if histories:
            with replacing(self._histories(key)) as temporary:
                with temporary.open("wb") as file:
                    np.savez_compressed(file, allow_pickle=False, **histories)
                size = temporary.stat().st_size
        text = json.dumps(asdict(record) | {"histories_size": size}, indent=1, allow_nan=False)
        with replacing(self._numbers(key)) as temporary:
            temporary.write_text(text + "\n", encoding="utf-8")

    def _numbers(self, key: str) -> Path:
        return self.folder / f"{key}.json"

    def _histories(self, key: str) -> Path:
        return self.folder / f"{key}.npz"


def open_store(folder: Path) -> Store:
    """Make a folder a store, or go on with one; what killed processes left is removed.

    Raises
    ------
    InputError
        For a folder that holds something else, or that cannot be made or written to.
    """
    folder = folder.resolve()
    mark = folder / MARK
    try:
        folder.mkdir(parents=True, exist_ok=True)
        found = {path.name for path in folder.iterdir() if not path.name.startswith(TEMPORARY)}
        if found and MARK not in found:
            raise InputError(
                f"--store {folder} holds other files than cases: name an empty or a new folder"
            )
        with replacing(mark) as temporary:
            temporary.write_text(json.dumps({"format": FORMAT}) + "\n", encoding="utf-8")
        _remove_abandoned(folder)
    except (OSError, RunError) as error:
        reason = getattr(error, "strerror", None) or error
        raise InputError(
            f"--store {folder} is no usable folder ({reason}): name another"
        ) from error
    return Store(folder)


def _remove_abandoned(folder: Path) -> None:
    oldest = time.time() - ABANDONED
    for path in folder.glob(f"{TEMPORARY}*"):
        if path.stat().st_mtime < oldest:
            shutil.rmtree(path, ignore_errors=True)
