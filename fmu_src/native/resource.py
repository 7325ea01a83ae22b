"""The resource that a native model starts from: named arrays in one checked block of bytes.

The layout is described in `c/binary.h`, which reads it.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Mapping, Sequence
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from fmu_src.python.variables import Value, Variable

Section: TypeAlias = NDArray[np.float64] | NDArray[np.int64] | bytes

MAGIC = b"RAILCOSM"
VERSION = 1
HEAD, ENTRY = struct.Struct("<8sIIQII"), struct.Struct("<24sIIQQ")
ALIGNMENT = 64
FLOAT64, INT64, BYTES = 1, 2, 3
LONGEST_NAME = 23


def pack(sections: Mapping[str, Section]) -> bytes:
    """Bytes of a resource.

    Parameters
    ----------
    sections : mapping of str to array or bytes
        Arrays of float64 or int64, of any shape, and bytes, by name.

    Raises
    ------
    ValueError
        If a name is too long or an array of another type.
    """
    entries: list[bytes] = []
    body: list[bytes] = []
    place = _aligned(HEAD.size + ENTRY.size * len(sections))
    lead = place - HEAD.size - ENTRY.size * len(sections)
    for name, values in sections.items():
        kind, count, data = _section(name, values)
        entries.append(ENTRY.pack(name.encode("ascii"), kind, 0, place, count))
        padded = _aligned(len(data))
        body.append(data.ljust(padded, b"\0"))
        place += padded
    checked = b"".join([*entries, bytes(lead), *body])
    size = HEAD.size + len(checked)
    return HEAD.pack(MAGIC, VERSION, len(sections), size, zlib.crc32(checked), 0) + checked


def start_values(variables: Sequence[Variable], changed: Mapping[str, Value]) -> dict[str, Section]:
    """Sections with the start values of parameters and inputs, in the order of the variables.

    Parameters
    ----------
    variables : sequence of Variable
        All variables of the FMU.
    changed : mapping of str to value
        Start values by name, where they differ from those declared.
    """
    known = [
        changed.get(variable.name, variable.start)
        for variable in variables
        if variable.causality != "output"
    ]
    texts = [value for value in known if isinstance(value, str)]
    return {
        "start": np.array([float(v) for v in known if not isinstance(v, str)]),
        "start_text": "".join(f"{text}\0" for text in texts).encode(),
    }


def _section(name: str, values: Section) -> tuple[int, int, bytes]:
    """Type, number of values and bytes of a section."""
    if len(name) > LONGEST_NAME:
        raise ValueError(
            f"resource: the name {name!r} has {len(name)} characters; at most {LONGEST_NAME} fit"
        )
    if isinstance(values, bytes):
        return BYTES, len(values), values
    kinds = {np.dtype(np.float64): (FLOAT64, "<f8"), np.dtype(np.int64): (INT64, "<i8")}
    if values.dtype not in kinds:
        raise ValueError(f"resource: {name} holds {values.dtype}; use float64 or int64")
    kind, stored = kinds[values.dtype]
    return kind, values.size, values.astype(stored).tobytes()


def _aligned(size: int) -> int:
    return -(-size // ALIGNMENT) * ALIGNMENT
