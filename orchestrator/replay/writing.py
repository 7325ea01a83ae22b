"""Writing replay files.

A replay file is a zip archive: ``replay.json``, the FMUs under ``fmus`` by the hash of their
content, and the serialised states under ``states``. Numbers keep all their bits.
"""

import json
from collections.abc import Sequence
from dataclasses import asdict
from hashlib import sha256
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile

import numpy as np
from numpy.typing import NDArray

from ..last_attempt import LastAttempt
from .case import ReplayCase

format_name = "railcosim replay 1"
document_name = "replay.json"


def write_replay(path: Path, case: ReplayCase) -> None:
    """Write a case with everything that belongs to it.

    Parameters
    ----------
    path : pathlib.Path
        The file; what it held is lost.
    case : ReplayCase
        The run that failed; its FMUs must still be there.

    Raises
    ------
    OSError
        When an FMU cannot be read or the file cannot be written.
    """
    contents = [source.path.read_bytes() for source in case.sources]
    hashes = [sha256(content).hexdigest() for content in contents]
    document = {
        "format": format_name,
        "name": case.name,
        "error": case.error,
        "start_time": case.start_time,
        "stop_time": case.stop_time,
        "settings": asdict(case.settings),
        "events": case.events,
        "observed": case.observed,
        "fmus": [
            {
                "name": source.name,
                "file": source.path.name,
                "sha256": digest,
                "start_values": dict(source.start_values),
                "timeout": source.timeout,
            }
            for source, digest in zip(case.sources, hashes, strict=True)
        ],
        "connections": [
            {"source": item.source, "target": item.target, "conversion": item.conversion}
            for item in case.connections
        ],
        "attempt": None if case.attempt is None else _attempt(case.attempt),
    }
    with ZipFile(path, "w", ZIP_DEFLATED) as archive:
        archive.writestr(document_name, json.dumps(document, indent=1))
        for digest, content in dict(zip(hashes, contents, strict=True)).items():
            archive.writestr(f"fmus/{digest}.fmu", content)
        for place, source in enumerate(case.sources):
            if case.attempt is not None:
                archive.writestr(f"states/{place}.bin", case.attempt.states[source.name])


def _attempt(attempt: LastAttempt) -> dict[str, object]:
    return {
        "time": attempt.time,
        "step_size": attempt.step_size,
        "landing": attempt.landing,
        "values": attempt.values.tolist(),
        "slope": _numbers(attempt.slope),
        "jacobians": _all_numbers(attempt.jacobians),
        "indicators": list(attempt.indicators),
    }


def _numbers(values: NDArray[np.float64] | None) -> object:
    return None if values is None else values.tolist()


def _all_numbers(arrays: Sequence[NDArray[np.float64] | None]) -> list[object]:
    return [_numbers(array) for array in arrays]
