"""What is said between an isolated FMU and the master: bytes that nobody has to trust.

A request is any number of operations, one after the other: a code and its fixed-size payload.
Values are raw float64, states are numbers. A report is a status, and what was asked for.
"""

import json
from collections.abc import Callable, Sequence
from enum import IntEnum
from math import isnan, nan
from struct import Struct
from typing import NamedTuple

from .participant import OK, Status, StatusKind

length = Struct("<I")
"""What stands before every request and report."""

number = Struct("<Q")
sized_number = Struct("<QI")
step_times = Struct("<2d")
experiment = Struct("<3d")
head = Struct("<Bd")

kinds = (
    StatusKind.OK,
    StatusKind.DISCARD,
    StatusKind.EARLY,
    StatusKind.ERROR,
    StatusKind.FATAL,
)
refused = len(kinds)
"""Code of a report that an operation without a status failed."""


class Operation(IntEnum):
    """First byte of an operation."""

    ENTER = 1
    EXIT = 2
    SET_INPUTS = 3
    STEP = 4
    GET_OUTPUTS = 5
    GET_OBSERVED = 6
    SAVE = 7
    RESTORE = 8
    RELEASE = 9
    SERIALISE = 10
    DESERIALISE = 11
    TERMINATE = 12
    GET_DERIVATIVES = 13


class Report(NamedTuple):
    """The answer to a request.

    Attributes
    ----------
    status : Status
        How the last operation that was carried out ended.
    payload : bytes
        What was asked for.
    messages : tuple of str
        What the FMU logged last, where it failed.
    raises : bool
        Whether the operation that failed raises an error instead of answering.
    """

    status: Status
    payload: bytes = b""
    messages: tuple[str, ...] = ()
    raises: bool = False


def write_report(report: Report) -> bytes:
    """Return a report as bytes."""
    status = report.status
    if status is OK:
        return head.pack(0, nan) + report.payload
    code = refused if report.raises else kinds.index(status.kind)
    until = nan if status.last_successful_time is None else status.last_successful_time
    words = {"message": status.message, "messages": list(report.messages)}
    return head.pack(code, until) + json.dumps(words).encode()


def read_report(data: bytes) -> Report:
    """Return the report that `write_report` wrote.

    Raises
    ------
    ValueError
        When it is none.
    """
    if len(data) < head.size or data[0] > refused:
        raise ValueError("the bytes are no report")
    code, until = head.unpack_from(data)
    if code == 0:
        return Report(OK, data[head.size :])
    words = json.loads(data[head.size :])
    kind = StatusKind.FATAL if code == refused else kinds[code]
    status = Status(kind, str(words["message"]), None if isnan(until) else until)
    messages = tuple(str(item) for item in words["messages"])
    return Report(status, messages=messages, raises=code == refused)


def read_frame(read: Callable[[int], bytes]) -> bytes | None:
    """Read one frame with `read`, which returns nothing at the end; None: nothing came."""
    start = _read_exactly(read, length.size)
    if len(start) < length.size:
        return None
    (size,) = length.unpack(start)
    data = _read_exactly(read, size)
    return data if len(data) == size else None


def write_frame(write: Callable[[memoryview], int], parts: Sequence[bytes]) -> None:
    """Write one frame with `write`, which returns how much it took."""
    body = b"".join(parts)
    data = memoryview(length.pack(len(body)) + body)
    while data:
        data = data[write(data) :]


def _read_exactly(read: Callable[[int], bytes], size: int) -> bytes:
    data = b""
    while len(data) < size:
        more = read(size - len(data))
        if not more:
            break
        data += more
    return data
