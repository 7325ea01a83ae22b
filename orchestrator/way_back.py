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


class Journal:
    """What an FMU was told, as far as another process must hear it to be in the same states.

    Points are kept from the first serialised state on: without one there is no way back.

    Attributes
    ----------
    setup : bytes
        Operations of the initialisation.
    """

    def __init__(self) -> None:
        self.setup = b""
        self._point: Point | None = None
        self._confirmed: Point | None = None
        self._states: dict[int, Point | None] = {}

    @property
    def steps(self) -> int:
        """Steps since the last serialised state, or 0 without one."""
        return 0 if self._point is None else self._point.steps

    @property
    def confirmed_steps(self) -> int:
        """The same at the last operation that was answered."""
        return 0 if self._confirmed is None else self._confirmed.steps

    def go_on(self, operation: bytes, *, steps: int = 0) -> None:
        """Add an operation that changes the present state."""
        before = self._point
        if before is not None:
            self._point = Point(before=before, operation=operation, steps=before.steps + steps)

    def confirm(self) -> None:
        """Note that everything so far was carried out."""
        self._confirmed = self._point

    def keep(self, state: int) -> None:
        """Note that the present state was saved under a number."""
        self._states[state] = self._point

    def keep_serialised(self, state: int, data: bytes, *, present: bool) -> None:
        """Note the bytes of the state of a number, and whether it is the `present` one."""
        self._states[state] = point = Point(before=None, data=data)
        if present:
            self._point = self._confirmed = point

    def go_back(self, state: int) -> None:
        """Note that the state of a number is the present one again."""
        self._point = self._states[state]

    def drop(self, state: int) -> bool:
        """Forget a saved state, and say whether there was one."""
        known = state in self._states
        self._states.pop(state, None)
        return known

    def way_to_present(self) -> bytes | None:
        """Return what leads a new process to all saved states and to the last confirmed one."""
        if self._confirmed is None:
            return None
        way = self.setup
        for state, point in self._states.items():
            if point is not None:
                way += way_to(point) + bytes([Operation.SAVE]) + number.pack(state)
        return way + way_to(self._confirmed)

    def way_to_state(self, state: int) -> bytes | None:
        """Return what leads a new process to the state of a number."""
        point = self._states.get(state)
        return None if point is None else self.setup + way_to(point)
