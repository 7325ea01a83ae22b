"""What a case is known by: a hash of everything that its result depends on."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict, fields
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import fmu_src
import orchestrator
import track_fmu
import vehicle_fmu
from fmu_src.archive import content_hash

from ..errors import InputError
from ..fields import holds_file
from ..run_record import programs
from ..scenario_file import LISTS, SECTIONS

if TYPE_CHECKING:
    from .case import Case

SOURCES = (".py", ".c", ".h")
"""Ends of the names of source files."""


class Fingerprints:
    """Contents of files as hashes, each file being read once."""

    def __init__(self) -> None:
        self._known: dict[str, str] = {}

    def of(self, path: str) -> str:
        """Return the hash of a file's content, 64 hexadecimal digits.

        Raises
        ------
        InputError
            Where it cannot be read.
        """
        if path not in self._known:
            try:
                content = Path(path).read_bytes()
            except OSError as error:
                raise InputError(f"cannot read {path}: {error.strerror}; check the path") from error
            self._known[path] = hashlib.sha256(content).hexdigest()
        return self._known[path]


def content_key(case: Case, fingerprints: Fingerprints) -> str:
    """Hash the resolved scenario, the files that it names, the options and the programs.

    The programs stand for the FMUs, which are built from them. Where the files lie does not
    matter.

    Parameters
    ----------
    case : Case
        A case of a study.
    fingerprints : Fingerprints
        Files that have been read.

    Returns
    -------
    str
        32 hexadecimal digits.

    Raises
    ------
    InputError
        For a file that cannot be read.
    """
    material = {
        "scenario": _described(case, fingerprints),
        "options": asdict(case.options),
        "programs": programs_in_use(),
    }
    text = json.dumps(material, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def files_of(case: Case) -> dict[tuple[str | int, ...], str]:
    """Return the paths of the files that a case names, by section, number of the table, key."""
    parts: dict[tuple[str | int, ...], Any] = {
        (name,): getattr(case.scenario, name) for name in SECTIONS
    }
    for name in LISTS:
        parts |= {(name, k): row for k, row in enumerate(getattr(case.scenario, name))}
    return {
        (*place, item.name): value
        for place, part in parts.items()
        for item in fields(part)
        if isinstance(value := getattr(part, item.name), str)
        and holds_file(type(part), item.name, value)
    }


@cache  # the code that is loaded stays the same while files of it change
def programs_in_use() -> dict[str, str]:
    """Name the versions of the libraries, and hash the sources of all that makes a result."""
    root = Path(__file__).parents[1]
    found = {
        f"railcosim/{path.relative_to(root)}": path
        for folder in (root, root / "irregularity", Path(__file__).parent)
        for path in folder.glob("*.py")
    }
    for package in (track_fmu, vehicle_fmu, fmu_src, orchestrator):
        folder = Path(str(package.__file__)).parent
        found |= {
            f"{package.__name__}/{path.relative_to(folder)}": path
            for path in folder.rglob("*")
            if path.suffix in SOURCES
        }
    sources = {name: path.read_bytes() for name, path in found.items()}
    return {**programs(), "sources": content_hash(sources)}


def _described(case: Case, fingerprints: Fingerprints) -> dict[str, Any]:
    """Return every key of the resolved scenario, files by their content."""
    keys = asdict(case.resolved)
    for (*place, key), path in files_of(case).items():
        part: Any = keys
        for name in place:
            part = part[name]
        part[key] = fingerprints.of(path)
    return keys
