"""How the state of a process that is gone is reached again in a new one."""

from dataclasses import dataclass

from .frames import Operation, number, sized_number


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Point:
    """A state of the FMU as the way that leads to it.

    Attributes
    ----------
    before : Point or None
        Where it comes from; None where `data` holds the state.
    operation : bytes
        What leads here from there.
    steps : int
        Steps since the last serialised state.
    data : bytes
        The serialised state, if this is one.
    """

    before: "Point | None"
    operation: bytes = b""
    steps: int = 0
    data: bytes = b""


def deserialising(state: int, data: bytes) -> bytes:
    """Return the operation that makes `data` the state of number `state`."""
    return bytes([Operation.DESERIALISE]) + sized_number.pack(state, len(data)) + data


def way_to(point: Point) -> bytes:
    """Return the operations that lead to `point` from the serialised state before it."""
    operations = []
    while point.before is not None:
        operations.append(point.operation)
        point = point.before
    start = deserialising(0, point.data)
    for operation in (Operation.RESTORE, Operation.RELEASE):
        start += bytes([operation]) + number.pack(0)
    return start + b"".join(reversed(operations))
