"""The icon of the FMUs: a wheel on a rail on sleepers, as a PNG file."""

from __future__ import annotations

import struct
import zlib

import numpy as np
from numpy.typing import NDArray

SIZE = 64  # pixels
INK, PAPER = (38, 70, 104), (255, 255, 255)
STORED = 0  # no compression: the same bytes from every version of zlib


def icon() -> bytes:
    """The icon of 64 by 64 pixels."""
    shape = _shape()
    pixels = np.where(shape[:, :, None], np.array(INK), np.array(PAPER)).astype(np.uint8)
    rows = np.zeros((SIZE, 1 + 3 * SIZE), np.uint8)  # a row begins with its filter: none
    rows[:, 1:] = pixels.reshape(SIZE, -1)
    head = struct.pack(">IIBBBBB", SIZE, SIZE, 8, 2, 0, 0, 0)
    return b"".join(
        (
            b"\x89PNG\r\n\x1a\n",
            _chunk(b"IHDR", head),
            _chunk(b"IDAT", zlib.compress(rows.tobytes(), STORED)),
            _chunk(b"IEND", b""),
        )
    )


def _shape() -> NDArray[np.bool_]:
    """Where there is ink."""
    y, x = np.mgrid[0:SIZE, 0:SIZE]
    radius = np.hypot(x - 31.5, y - 25.5)
    wheel = ((radius < 20.0) & (radius > 16.0)) | (radius < 4.0)
    rail = (y >= 46) & (y < 50)
    sleepers = (y >= 52) & (y < 58) & (x % 16 >= 4) & (x % 16 < 12)
    shape: NDArray[np.bool_] = wheel | rail | sleepers
    return shape


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
