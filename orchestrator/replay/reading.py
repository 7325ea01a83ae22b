"""Reading replay files."""

import json
import zipfile
import zlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from hashlib import sha256
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from ..archives import find_danger
from ..errors import SystemFileError
from ..fmu_source import FmuSource
from ..last_attempt import LastAttempt
from ..settings import MasterSettings
from ..system import Connection
from ..units import Linear
from .case import ReplayCase
from .writing import document_name, format_name


@contextmanager
def open_replay(path: Path) -> Iterator[ReplayCase]:
    """Read a replay file; its FMUs are there as long as the context lasts.

    Parameters
    ----------
    path : pathlib.Path
        The file.

    Yields
    ------
    ReplayCase
        The run that failed.

    Raises
    ------
    InputError
        When it is no intact replay file.
    """
    if not path.is_file():
        raise SystemFileError(f"{path}: there is no such file.")
    with TemporaryDirectory(prefix="replay-", ignore_cleanup_errors=True) as folder:
        try:
            with zipfile.ZipFile(path) as archive:
                danger = find_danger(archive)
                if danger is not None:
                    raise SystemFileError(f"{path.name}: it is not unpacked: {danger}.")
                archive.extractall(folder)
        except (zipfile.BadZipFile, zlib.error, EOFError, RuntimeError, OSError) as error:
            raise SystemFileError(
                f"{path.name}: it cannot be unpacked as a replay file: {error}."
            ) from error
        try:
            case = _read(Path(folder))
        except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
            raise SystemFileError(
                f"{path.name}: it is no replay file of this version of the program "
                f"({' '.join(str(error).split())})."
            ) from error
        yield case


def _read(folder: Path) -> ReplayCase:
    document = json.loads((folder / document_name).read_text(encoding="utf-8"))
    if document["format"] != format_name:
        raise ValueError(f"the format is {document['format']!r}, not {format_name!r}")
    sources = tuple(_source(item, folder) for item in document["fmus"])
    attempt = document["attempt"]
    return ReplayCase(
        name=str(document["name"]),
        sources=sources,
        connections=tuple(_connection(item) for item in document["connections"]),
        settings=MasterSettings(**document["settings"]),
        events=tuple(map(str, document["events"])),
        observed=tuple(map(str, document["observed"])),
        start_time=float(document["start_time"]),
        stop_time=float(document["stop_time"]),
        error=str(document["error"]),
        attempt=None if attempt is None else _attempt(attempt, sources, folder),
    )


def _source(item: Mapping[str, Any], folder: Path) -> FmuSource:
    digest = str(item["sha256"])
    path = folder / "fmus" / f"{digest}.fmu"
    if not digest.isalnum() or sha256(path.read_bytes()).hexdigest() != digest:
        raise ValueError(f"the content of {item['file']} is not the one that it was")
    timeout = item["timeout"]
    return FmuSource(
        path=path,
        name=str(item["name"]),
        start_values=dict(item["start_values"]),
        timeout=None if timeout is None else float(timeout),
    )


def _connection(item: Mapping[str, Any]) -> Connection:
    conversion = item["conversion"]
    return Connection(
        source=str(item["source"]),
        target=str(item["target"]),
        conversion=None if conversion is None else Linear(*map(float, conversion)),
    )


def _attempt(item: Mapping[str, Any], sources: tuple[FmuSource, ...], folder: Path) -> LastAttempt:
    slope, landing = item["slope"], item["landing"]
    return LastAttempt(
        time=float(item["time"]),
        step_size=float(item["step_size"]),
        landing=None if landing is None else float(landing),
        values=np.array(item["values"], dtype=float),
        slope=None if slope is None else np.array(slope, dtype=float),
        jacobians=[
            None if one is None else np.array(one, dtype=float) for one in item["jacobians"]
        ],
        indicators=tuple(map(float, item["indicators"])),
        states={
            source.name: (folder / "states" / f"{place}.bin").read_bytes()
            for place, source in enumerate(sources)
        },
    )
