"""Puts a native model into the contents of an FMU, of FMI 2.0 or of FMI 3.0."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Callable, Collection, Mapping
from pathlib import Path
from typing import Literal, TypeAlias
from xml.etree.ElementTree import ParseError, fromstring

import track_fmu
from fmu_src.archive import content_hash

from .compiler import TARGETS, source_files
from .documentation import document
from .icon import icon
from .library_cache import cached_library
from .model_description import describe_fmi2, describe_fmi3
from .model_sources import MODELS
from .models import NativeModel, described
from .terminals import describe_sources, describe_terminals
from .universal import universal_library

FmiVersion: TypeAlias = Literal[2, 3]
Notify: TypeAlias = Callable[[str], None] | None

ICONS = ("terminalsAndIcons/icon.png", "terminalsAndIcons/wheel.png")
PYTHON_FILES = [
    *Path(__file__).parent.glob("*.py"),
    *(Path(__file__).parents[1] / "python").glob("*_variables.py"),
    *(
        Path(__file__).parents[1] / "python" / name
        for name in ("variables.py", "model_description.py")
    ),
    *Path(str(track_fmu.__file__)).parent.glob("*.py"),
]
"""Code that makes the resources and the descriptions."""


def build_token(model: NativeModel) -> str:
    """Identity of the FMUs of a model: a hash of all sources and of its declaration."""
    python = {f"{path.parent.name}/{path.name}": path.read_bytes() for path in PYTHON_FILES}
    return content_hash(
        source_files(model.kind) | python | {"/declaration": described(model)},
    )


def fmu_contents(
    model: NativeModel,
    *,
    fmi_version: FmiVersion,
    platforms: Collection[str] = tuple(TARGETS),
    notify: Notify = None,
) -> dict[str, bytes]:
    """Contents of an FMU by file name.

    Parameters
    ----------
    model : NativeModel
        The model.
    fmi_version : {2, 3}
        2.0 or 3.0.
    platforms : collection of str
        Keys of `compiler.TARGETS`: what to compile for.
    notify : callable, optional
        Told in a few words when something has to be compiled.

    Raises
    ------
    compiler.CompilationError
        If a library has to be compiled and cannot.
    """
    token = build_token(model)
    sources = _sources(model, fmi_version)
    compiled = [name for name in sources if name.endswith(".c")]
    contents = _binaries(model, fmi_version, platforms, notify)
    contents |= {f"sources/{name}": data for name, data in sources.items()}
    contents |= {
        "resources/build.txt": f"{token}\n".encode(),
        "resources/model.bin": model.make_resource(),
        "documentation/index.html": document(model),
    }
    if fmi_version == 2:
        description = describe_fmi2(model, token=token, sources=compiled)
        return contents | {"modelDescription.xml": description, "model.png": icon()}
    return contents | {
        "modelDescription.xml": describe_fmi3(model, token=token),
        "sources/buildDescription.xml": describe_sources(model, compiled),
        "terminalsAndIcons/terminalsAndIcons.xml": describe_terminals(model),
        **dict.fromkeys(ICONS, icon()),
    }


def is_current(
    path: Path, model: NativeModel, *, fmi_version: FmiVersion, platforms: Collection[str]
) -> bool:
    """Tell whether a sound FMU of this model, with libraries for these platforms, is there."""
    wanted = set(_folders(model, fmi_version, platforms))
    name = "guid" if fmi_version == 2 else "instantiationToken"
    try:
        with zipfile.ZipFile(path) as archive:
            root = fromstring(archive.read("modelDescription.xml"))  # noqa: S314 - written by this project
            return (
                root.get(name) == build_token(model)
                and wanted <= set(archive.namelist())
                and archive.testzip() is None
            )
    except (OSError, KeyError, ParseError, zipfile.BadZipFile, EOFError, NotImplementedError):
        return False


def _sources(model: NativeModel, fmi_version: FmiVersion) -> dict[str, bytes]:
    """What a host has to compile; nothing of the other version."""
    other = re.compile(rf"fmi{5 - fmi_version}\w*\.[ch]")
    return {
        name: data
        for name, data in sorted(source_files(model.kind).items())
        if not other.fullmatch(name)
    }


def _folders(
    model: NativeModel, fmi_version: FmiVersion, platforms: Collection[str]
) -> Mapping[str, list[str]]:
    """Libraries of the FMU by file name: the platforms that each is for.

    FMI 2.0 has one folder for macOS, so that the library in it is for both processors, and none
    for Linux on aarch64.
    """
    found: dict[str, list[str]] = {}
    for platform in TARGETS:
        folder = platform if fmi_version == 3 else TARGETS[platform].folder
        if platform in platforms and folder:
            file = f"binaries/{folder}/{model.name}{TARGETS[platform].suffix}"
            found.setdefault(file, []).append(platform)
    return found


def _binaries(
    model: NativeModel, fmi_version: FmiVersion, platforms: Collection[str], notify: Notify
) -> dict[str, bytes]:
    assert model.kind in MODELS
    libraries = {}
    for file, targets in _folders(model, fmi_version, platforms).items():
        parts = [
            cached_library(model.kind, target, name=model.name, notify=notify) for target in targets
        ]
        libraries[file] = parts[0] if len(parts) == 1 else universal_library(parts)
    return libraries
