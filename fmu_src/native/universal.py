"""Universal libraries for macOS: one file with a library for each kind of processor."""

from __future__ import annotations

import struct
from collections.abc import Sequence

HEAD = struct.Struct(">II")  # magic, number of slices
SLICE = struct.Struct(">iiIII")  # kind and subkind of processor, place, size, power of alignment
MAGIC = 0xCAFEBABE
THIN_MAGIC = b"\xcf\xfa\xed\xfe"
ALIGNMENT = 14  # power of two: pages of arm64


def universal_library(libraries: Sequence[bytes]) -> bytes:
    """Join libraries for one processor each.

    Parameters
    ----------
    libraries : sequence of bytes
        64-bit Mach-O libraries.

    Raises
    ------
    ValueError
        If one is no such library.
    """
    head, body = [HEAD.pack(MAGIC, len(libraries))], b""
    first = 1 << ALIGNMENT
    for library in libraries:
        if not library.startswith(THIN_MAGIC):
            raise ValueError("a universal library is made of 64-bit Mach-O libraries only")
        processor, kind = struct.unpack_from("<ii", library, 4)
        place = first + len(body)
        head.append(SLICE.pack(processor, kind, place, len(library), ALIGNMENT))
        body += library + bytes(-len(library) % first)
    return b"".join(head).ljust(first, b"\0") + body
