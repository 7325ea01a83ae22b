"""Native FMUs as files: which are up to date, what they are called, how many are kept."""

from __future__ import annotations

from collections.abc import Callable, Collection
from pathlib import Path

from fmu_src.archive import write_archive

from .compiler import this_target
from .models import NativeModel
from .packaging import FmiVersion, build_token, fmu_contents, is_current

VARIANT, DIGITS = "-basis-", 12  # in names of tracks other than the paper's: part of their token
KEPT_VARIANTS = 8
"""Tracks of one size that are kept besides the paper's."""


def ensure_archive(
    directory: Path,
    stem: str,
    model: NativeModel,
    *,
    fmi_version: FmiVersion,
    platforms: Collection[str] | None = None,
    progress: Callable[[str], None] | None = None,
) -> Path:
    """Build the FMU of a model if it is missing or stale, and return where it is.

    Parameters
    ----------
    directory : Path
        Where it is kept.
    stem : str
        Name of the file for a model with the usual constants, without its suffix.
    model : NativeModel
        The model.
    fmi_version : {2, 3}
        2.0 or 3.0.
    platforms : collection of str, optional
        What to compile for, keys of `compiler.TARGETS`; this machine without.
    progress : callable, optional
        Told what is being built.

    Raises
    ------
    compiler.CompilationError
        If something has to be compiled and cannot.
    OSError
        If the archive cannot be written.
    """
    platforms = (this_target(),) if platforms is None else platforms
    ending = "-fmi3.fmu" if fmi_version == 3 else ".fmu"
    name = f"{stem}{'' if model.usual else VARIANT + build_token(model)[:DIGITS]}{ending}"
    path = directory / name
    if is_current(path, model, fmi_version=fmi_version, platforms=platforms):
        return path
    if progress is not None:
        progress(f"building {path.name}")
    contents = fmu_contents(model, fmi_version=fmi_version, platforms=platforms, notify=progress)
    write_archive(path, contents)
    if not model.usual:
        _forget_oldest(directory, f"{stem}{VARIANT}{'[0-9a-f]' * DIGITS}{ending}")
    return path


def _forget_oldest(directory: Path, pattern: str) -> None:
    """Remove the oldest files of this pattern beyond those that are kept."""
    found = sorted(directory.glob(pattern), key=lambda path: path.stat().st_mtime)
    for path in found[:-KEPT_VARIANTS]:
        path.unlink(missing_ok=True)
