"""The complete state of a slave, and its versioned binary form.

Layout, little-endian: magic ``RCST``, format version (u16); then, in this order, the identity of
the build, phase (u8), time (f64), the parameters, the inputs, the model's state; a CRC-32 of
everything before it (u32). Strings and arrays carry their length (u32); every parameter carries
its type (u8: 0 Real, 1 Integer, 2 Boolean, 3 String); a missing model state has length 2^32 - 1.
"""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass
from enum import IntEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .variables import Value

MAGIC = b"RCST"
VERSION = 1
MISSING = 0xFFFFFFFF


class Phase(IntEnum):
    """Where a slave is in its life."""

    INSTANTIATED = 0
    INITIALISING = 1
    STEPPING = 2


@dataclass(frozen=True, slots=True, kw_only=True)
class SlaveState:
    """Everything that determines how a slave goes on.

    Attributes
    ----------
    identity : str
        Name and build of the FMU that made it.
    phase : int
        Phase of the slave's life.
    time : float
        Communication point [s].
    parameters : tuple
        Values of all parameters, in the order of the model description.
    inputs : (k,) float array
        Inputs as last set.
    model : (size,) float array or None
        State of the model, None before there is one.
    """

    identity: str
    phase: int
    time: float
    parameters: tuple[Value, ...]
    inputs: NDArray[np.float64]
    model: NDArray[np.float64] | None


def to_bytes(state: SlaveState) -> bytes:
    """Binary form of a state."""
    parts = [
        MAGIC,
        struct.pack("<H", VERSION),
        _text(state.identity),
        struct.pack("<Bd", state.phase, state.time),
        struct.pack("<I", len(state.parameters)),
    ]
    parts += [_value(value) for value in state.parameters]
    parts += [_array(state.inputs), _array(state.model)]
    body = b"".join(parts)
    return body + struct.pack("<I", zlib.crc32(body))


def from_bytes(data: bytes) -> SlaveState:
    """State from its binary form.

    Raises
    ------
    ValueError
        If the bytes are not such a state, are of another format version or damaged.
    """
    if data[:4] != MAGIC or len(data) < 10:
        raise ValueError("these bytes are not a serialised state of a railcosim FMU")
    if (version := struct.unpack_from("<H", data, 4)[0]) != VERSION:
        raise ValueError(f"the serialised state has format {version}; this FMU reads {VERSION}")
    if zlib.crc32(data[:-4]) != struct.unpack("<I", data[-4:])[0]:
        raise ValueError("the serialised state is truncated or altered (checksum)")
    reader = _Reader(data, 6)
    identity = reader.text()
    phase, time = reader.unpack("<Bd")
    parameters = tuple(reader.value() for _ in range(reader.unpack("<I")[0]))
    inputs, model = reader.array(), reader.array()
    if inputs is None:
        raise ValueError("the serialised state has no inputs")
    return SlaveState(
        identity=identity, phase=phase, time=time, parameters=parameters, inputs=inputs, model=model
    )


def _text(text: str) -> bytes:
    data = text.encode()
    return struct.pack("<I", len(data)) + data


def _value(value: Value) -> bytes:
    if isinstance(value, str):
        return b"\x03" + _text(value)
    if isinstance(value, bool):
        return struct.pack("<BB", 2, value)
    if isinstance(value, int):
        return struct.pack("<Bq", 1, value)
    return struct.pack("<Bd", 0, value)


def _array(array: NDArray[np.float64] | None) -> bytes:
    if array is None:
        return struct.pack("<I", MISSING)
    return struct.pack("<I", len(array)) + array.astype("<f8").tobytes()


class _Reader:
    """Reads one part after the other."""

    def __init__(self, data: bytes, offset: int) -> None:
        self._data, self._offset = data, offset

    def unpack(self, layout: str) -> tuple[Any, ...]:
        values = struct.unpack_from(layout, self._data, self._offset)
        self._offset += struct.calcsize(layout)
        return values

    def take(self, length: int) -> bytes:
        part = self._data[self._offset : self._offset + length]
        self._offset += length
        return part

    def text(self) -> str:
        return self.take(int(self.unpack("<I")[0])).decode()

    def value(self) -> Value:
        kind = self.unpack("<B")[0]
        if kind == 3:
            return self.text()
        if kind == 2:
            return bool(self.unpack("<B")[0])
        return int(self.unpack("<q")[0]) if kind == 1 else float(self.unpack("<d")[0])

    def array(self) -> NDArray[np.float64] | None:
        length = int(self.unpack("<I")[0])
        if length == MISSING:
            return None
        return np.frombuffer(self.take(8 * length), dtype="<f8").astype(np.float64)
