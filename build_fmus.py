"""Builds the FMUs of the track and of the vehicle.

``python build_fmus.py`` writes them to ``dist/``; what is there and up to date, byte for byte what
the present sources give, is left alone. There are two pairs: the contacts are those of the vehicle
or of the track. The FMUs of the default structure come with their systems in the paper's case.
``--kind native`` compiles the models in C instead, into ``dist/native/``.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, fields
from pathlib import Path

import platformdirs

from fmu_src.archive import holds, write_archive
from fmu_src.native.archives import ensure_archive
from fmu_src.native.compiler import TARGETS, CompilationError
from fmu_src.native.models import (
    TRACK_CONSTANTS,
    native_masses,
    native_track,
    native_vehicle,
)
from fmu_src.native.packaging import FmiVersion
from fmu_src.python.packaging import RECIPES, fmu_contents
from fmu_src.python.variables import Value

PAIRS = {"vehicle": ("track", "vehicle"), "track": ("track_contact", "masses")}
"""Kinds of the FMUs of track and vehicle by the side that has the contacts."""

TRACK_SIZE = ("bays", "elements_per_bay", "wheels", "gauges")
VEHICLE_SIZE = ("wheels", "bogies")
TRACKS = {track for track, _ in PAIRS.values()}
KINDS = ("python", "native")


@dataclass(frozen=True, slots=True, kw_only=True)
class Structure:
    """What is fixed when an FMU is built.

    Parameters
    ----------
    bays, elements_per_bay : int
        Size of the track.
    wheels : int
        Number of wheels.
    gauges : int
        Number of bending moment gauges.
    bogies : int
        Number of bogies, which share the wheels.

    Raises
    ------
    ValueError
        If a number is too small.
    """

    bays: int = 50
    elements_per_bay: int = 8
    wheels: int = 2
    gauges: int = 3
    bogies: int = 1

    def __post_init__(self) -> None:
        for name, least in (
            ("bays", 2),
            ("elements_per_bay", 1),
            ("wheels", 1),
            ("gauges", 0),
            ("bogies", 1),
        ):
            if getattr(self, name) < least:
                raise ValueError(f"{name} is {getattr(self, name)}; it must be at least {least}")
        if self.wheels % self.bogies:
            raise ValueError(
                f"{self.wheels} wheels cannot be shared out among {self.bogies} bogies; give every "
                "bogie as many"
            )

    def of(self, kind: str) -> dict[str, int]:
        """The part that matters to the FMU of a kind."""
        names = TRACK_SIZE if kind in TRACKS else VEHICLE_SIZE
        return {name: getattr(self, name) for name in names}

    def file_name(self, kind: str) -> str:
        """File name of the FMU of a kind; the default structure has the plain name."""
        defaults = {field.name: field.default for field in fields(self)}
        changed = {k: v for k, v in self.of(kind).items() if v != defaults[k]}
        suffix = "".join(f"-{value}{name.replace('_', '-')}" for name, value in changed.items())
        return f"{RECIPES[kind].name}{suffix}.fmu"


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


def default_directory() -> Path:
    """``dist/`` of a source checkout, otherwise a folder in the user's cache."""
    root = Path(__file__).resolve().parent
    if (root / "pyproject.toml").is_file():
        return root / "dist"
    return Path(platformdirs.user_cache_dir("railcosim", appauthor=False)) / "fmus"


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


def main() -> int:
    """Build from the command line; returns the exit code."""
    parser = argparse.ArgumentParser(description="Build the track and vehicle FMUs.")
    parser.add_argument("--output", type=Path, help="folder; dist/ or dist/native/ without")
    parser.add_argument("--kind", choices=KINDS, default="python", help="default %(default)s")
    parser.add_argument(
        "--platform",
        action="append",
        choices=TARGETS,
        help="of native FMUs; may be repeated; all of them without",
    )
    for field in fields(Structure):
        option = "--" + field.name.replace("_", "-")
        parser.add_argument(option, type=int, default=field.default, help="default %(default)s")
    arguments = vars(parser.parse_args())
    directory, kind, platforms = (arguments.pop(name) for name in ("output", "kind", "platform"))
    if platforms and kind != "native":
        parser.error("--platform is for --kind native")
    directory = directory or folder_of(kind)
    try:
        structure = Structure(**arguments)
        if structure == Structure():
            return _build_passage(directory, kind, platforms or ())
        built = _build(directory, structure, kind, platforms or tuple(TARGETS))
    except ValueError as error:
        print(f"build_fmus: {error}", file=sys.stderr)
        return 2
    except CompilationError as error:
        print(f"build_fmus: {error}", file=sys.stderr)
        return 1
    except OSError as error:
        print(f"build_fmus: cannot write to {directory}: {error.strerror}", file=sys.stderr)
        return 1
    for paths in built:
        print(paths.track, paths.vehicle, sep="\n")
    return 0


def folder_of(kind: str) -> Path:
    """Where the FMUs of a kind, python or native, are kept if nothing is said."""
    return default_directory() / "native" if kind == "native" else default_directory()


def _build(
    directory: Path, structure: Structure, kind: str, platforms: Collection[str]
) -> list[FmuPaths]:
    def say(text: str) -> None:
        print(text, file=sys.stderr)

    if kind == "native":
        versions: tuple[FmiVersion, ...] = (2, 3)
        return [
            ensure_native_fmus(
                directory,
                structure,
                contact=contact,
                fmi_version=version,
                platforms=platforms,
                progress=say,
            )
            for contact in PAIRS
            for version in versions
        ]
    return [ensure_fmus(directory, structure, contact=contact, progress=say) for contact in PAIRS]


def _build_passage(directory: Path, kind: str, platforms: Collection[str]) -> int:
    """Leave the default structure to the application, which knows the numbers of its passage."""
    command = [sys.executable, "-m", "railcosim", "build", "--output", str(directory.resolve())]
    command += ["--kind", kind, *(part for name in platforms for part in ("--platform", name))]
    done = subprocess.run(command, cwd=Path(__file__).resolve().parent, check=False)  # noqa: S603 - fixed
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
