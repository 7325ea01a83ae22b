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
from collections.abc import Collection
from dataclasses import fields
from pathlib import Path

from fmu_src.building import KINDS, FmuPaths, ensure_fmus, ensure_native_fmus, folder_of
from fmu_src.native.compiler import TARGETS, CompilationError
from fmu_src.native.packaging import FmiVersion
from fmu_src.structure import PAIRS, Structure


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
