"""Reproducible zip archives: the same content gives the same bytes."""

from __future__ import annotations

import hashlib
import os
import tempfile
import zipfile
from collections.abc import Mapping
from pathlib import Path

TIMESTAMP = (1980, 1, 1, 0, 0, 0)  # the earliest that a zip archive can say
PERMISSIONS = 0o644 << 16


def content_hash(files: Mapping[str, bytes]) -> str:
    """Hash over names and contents of files, as 32 hexadecimal digits."""
    digest = hashlib.sha256()
    for name in sorted(files):
        digest.update(f"{name}\0{len(files[name])}\0".encode())
        digest.update(files[name])
    return digest.hexdigest()[:32]


def holds(path: Path, files: Mapping[str, bytes]) -> bool:
    """Tell whether a sound archive of exactly these files is there."""
    try:
        with zipfile.ZipFile(path) as archive:
            names = archive.namelist()
            return sorted(names) == sorted(files) and all(
                archive.read(name) == data for name, data in files.items()
            )
    except Exception:  # noqa: BLE001 - whatever a damaged archive makes zipfile raise
        return False


def write_archive(path: Path, files: Mapping[str, bytes]) -> None:
    """Write files, sorted by name and compressed, in one move: never a half-written archive.

    Parameters
    ----------
    path : Path
        The archive; its folder is made if missing.
    files : mapping of str to bytes
        Contents by name, with forward slashes.

    Raises
    ------
    OSError
        If the archive cannot be written.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=path.name, suffix=".tmp")
    partial = Path(name)
    try:
        with os.fdopen(handle, "wb") as stream, zipfile.ZipFile(stream, "w") as archive:
            for member in sorted(files):
                info = zipfile.ZipInfo(member, TIMESTAMP)
                info.compress_type = zipfile.ZIP_DEFLATED
                info.create_system = 3  # Unix, wherever the archive is written
                info.external_attr = PERMISSIONS
                archive.writestr(info, files[member])
        partial.chmod(0o644)
        partial.replace(path)
    except BaseException:
        partial.unlink(missing_ok=True)
        raise
