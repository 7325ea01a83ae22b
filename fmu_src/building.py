"""The FMUs of track and vehicle in a folder, built where they are missing or stale.

What is there and up to date, byte for byte what the present sources give, is left alone.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from pathlib import Path

import platformdirs

from .archive import holds, write_archive
from .native.archives import ensure_archive
from .native.models import TRACK_CONSTANTS, native_masses, native_track, native_vehicle
from .native.packaging import FmiVersion
from .python.packaging import fmu_contents
from .python.variables import Value
from .structure import PAIRS, Structure

KINDS = ("python", "native")
"""What an FMU may be built of: the numpy models, or their twins in C."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FmuPaths:
    """Where the FMUs of a passage are.

    Attributes
    ----------
    track, vehicle : Path
        The archives.
    fixed : tuple of str
        Parameters of the track that cannot be set, because its modes were computed with them.
    """

    track: Path
    vehicle: Path
    fixed: tuple[str, ...] = ()


def folder_of(kind: str) -> Path:
    """Where the FMUs of a kind are kept if nothing is said.

    That is ``dist/`` of a source checkout, otherwise a folder in the user's cache; native ones lie
    in ``native/`` within.
    """
    root = Path(__file__).resolve().parents[1]
    checkout = (root / "pyproject.toml").is_file()
    cache = Path(platformdirs.user_cache_dir("railcosim", appauthor=False))
    folder = root / "dist" if checkout else cache / "fmus"
    return folder / "native" if kind == "native" else folder


def ensure_fmus(
    directory: Path,
    structure: Structure | None = None,
    *,
    contact: str = "vehicle",
    progress: Callable[[str], None] | None = None,
) -> FmuPaths:
    """Build the FMUs that are missing or stale.

    Parameters
    ----------
    directory : Path
        Where they are kept.
    structure : Structure, optional
        What is fixed at build time; the paper's track and bogie without.
    contact : str
        A key of `PAIRS`: which side has the contacts.
    progress : callable
        Told what is being built.

    Raises
    ------
    OSError
        If an archive cannot be written.
    """
    structure = structure or Structure()
    paths = []
    for kind in PAIRS[contact]:
        path = directory / structure.file_name(kind)
        paths.append(path)
        contents = fmu_contents(kind, structure.of(kind))
        if not holds(path, contents):
            if progress is not None:
                progress(f"building {path.name}")
            write_archive(path, contents)
    track, vehicle = paths
    return FmuPaths(track=track, vehicle=vehicle)


def ensure_native_fmus(
    directory: Path,
    structure: Structure | None = None,
    *,
    contact: str = "vehicle",
    fixed: Mapping[str, Value] | None = None,
    fmi_version: FmiVersion = 2,
    platforms: Collection[str] | None = None,
    progress: Callable[[str], None] | None = None,
) -> FmuPaths:
    """Build the native FMUs that are missing or stale.

    Parameters
    ----------
    directory : Path
        Where they are kept.
    structure : Structure, optional
        What is fixed at build time; the paper's track and bogie without.
    contact : str
        A key of `PAIRS`: which side has the contacts.
    fixed : mapping of str to float, int or bool, optional
        Values of `TRACK_CONSTANTS` other than the paper's. FMUs of such tracks have a name of
        their own; only the last ones built are kept.
    fmi_version : {2, 3}
        2.0 or 3.0.
    platforms : collection of str, optional
        What to compile for, keys of `fmu_src.native.compiler.TARGETS`; this machine without.
    progress : callable
        Told what is being built.

    Raises
    ------
    ValueError
        For values that no track can have.
    CompilationError
        If something has to be compiled and cannot.
    OSError
        If an archive cannot be written.
    """
    structure = structure or Structure()
    on_track = contact == "track"
    make_vehicle = native_masses if on_track else native_vehicle
    track, vehicle = (
        ensure_archive(
            directory,
            Path(structure.file_name(model.kind)).stem,
            model,
            fmi_version=fmi_version,
            platforms=platforms,
            progress=progress,
        )
        for model in (
            native_track(**structure.of("track"), fixed=fixed or {}, contact=on_track),
            make_vehicle(**structure.of("vehicle")),
        )
    )
    return FmuPaths(track=track, vehicle=vehicle, fixed=TRACK_CONSTANTS)
