"""Opening a system description, bare or in an archive."""

import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from ..archives import ArchiveLimits, default_limits, find_danger
from ..errors import SystemFileError
from .assembly import AssembledSystem, assemble
from .files import Folder
from .reading import read_description

description_name = "SystemStructure.ssd"
"""The description in an archive; others are variants, which are left alone."""


@contextmanager
def open_system(
    path: Path, *, timeout: float | None = None, limits: ArchiveLimits = default_limits
) -> Iterator[AssembledSystem]:
    """Read an .ssp or .ssd file and put its system together.

    The FMUs of an archive are there as long as the context lasts: run the system within it.

    Parameters
    ----------
    path : pathlib.Path
        The file; what it holds decides, not its ending.
    timeout : float, optional
        Longest answer of an FMU to one call [s], each FMU then being in a process of its own.
    limits : ArchiveLimits
        What an archive may amount to.

    Yields
    ------
    AssembledSystem
        The description and the system ready to run.

    Raises
    ------
    InputError
        For a file, an FMU, a connection or a value that cannot be used.
    """
    if not path.is_file():
        raise SystemFileError(f"{path}: there is no such file.")
    if not zipfile.is_zipfile(path):
        if path.suffix.lower() == ".ssp":
            raise SystemFileError(f"{path.name}: the file is no intact zip archive.")
        yield _read(path, Folder(path=path.parent, is_closed=False), timeout)
        return
    with TemporaryDirectory(prefix="ssp-", ignore_cleanup_errors=True) as folder:
        _unpack(path, folder, limits)
        description = Path(folder) / description_name
        if not description.is_file():
            raise SystemFileError(f"{path.name}: the archive holds no {description_name}.")
        yield _read(description, Folder(path=Path(folder), is_closed=True), timeout)


def _read(path: Path, folder: Folder, timeout: float | None) -> AssembledSystem:
    return assemble(read_description(path, folder), folder, timeout=timeout)


def _unpack(path: Path, folder: str, limits: ArchiveLimits) -> None:
    try:
        with zipfile.ZipFile(path) as archive:
            danger = find_danger(archive, limits)
            if danger is not None:
                raise SystemFileError(f"{path.name}: the archive is not unpacked: {danger}.")
            archive.extractall(folder)
    # zipfile raises the last two for encrypted entries and unknown compressions.
    except (zipfile.BadZipFile, zlib.error, EOFError, RuntimeError, NotImplementedError) as error:
        raise SystemFileError(
            f"{path.name}: the archive cannot be unpacked: {' '.join(str(error).split())}."
        ) from error
    except OSError as error:
        raise SystemFileError(
            f"{path.name}: the archive cannot be unpacked ({error.strerror or error})."
        ) from error
