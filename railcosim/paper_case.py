"""What is built for the paper's case: its FMUs, and its systems of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fmu_src.native.compiler import TARGETS

from .builds import build_for
from .errors import InputError
from .passage_package import ensure_package
from .scenario import Scenario

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Mapping
    from pathlib import Path

    from .signals import ContactSide

PACKAGE_NAMES: Mapping[ContactSide, str] = {
    "vehicle": "Passage.ssp",
    "track": "contact_on_track/PassageContactOnTrack.ssp",
}
"""Files of the paper's case as a system; only one beside the FMUs, so that ``*.ssp`` names it."""


def build_python(folder: Path, *, notify: Callable[[str], None]) -> list[Path]:
    """Build both pairs of Python FMUs with their systems; return all files.

    Raises
    ------
    RunError
        Where they cannot be written.
    """
    files = []
    for contact, name in PACKAGE_NAMES.items():
        paths = build_for(Scenario(), contact=contact, directory=folder, notify=notify)
        package = folder / name
        ensure_package(Scenario(), paths, package, contact=contact, notify=notify)
        files += [paths.track, paths.vehicle, package]
    return files


def build_native(
    folder: Path, platforms: Collection[str], *, notify: Callable[[str], None]
) -> list[Path]:
    """Build both pairs of native FMUs, those of FMI 2.0 with their systems, and those of FMI 3.0.

    Raises
    ------
    InputError
        For a platform that there is none of.
    RunError
        Where they cannot be compiled or written.
    """
    unknown = [name for name in platforms if name not in TARGETS]
    if unknown:
        raise InputError(f"--platform is {unknown[0]!r} but must be one of {', '.join(TARGETS)}")
    files = []
    for contact, name in PACKAGE_NAMES.items():
        for version in (2, 3):
            paths = build_for(
                Scenario(),
                "native",
                contact=contact,
                directory=folder,
                fmi_version=version,
                platforms=platforms,
                notify=notify,
            )
            files += [paths.track, paths.vehicle]
            if version == 2:
                package = folder / name
                ensure_package(Scenario(), paths, package, contact=contact, notify=notify)
                files.append(package)
    return files
