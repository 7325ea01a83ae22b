"""Reading and writing groups of FMU variables: one call per type and nothing allocated."""

from collections.abc import Callable, Mapping, Sequence
from ctypes import c_size_t, c_uint, c_void_p
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..participant import Vector
from .description import FmuDescription, StartValue
from .fixed_call import fixed_call

FmiFunctions = Mapping[str, Callable[..., Any]]
"""Raw functions of the shared library by FMI name."""

Indices = NDArray[np.intp]


class Target(NamedTuple):
    """Whom to call.

    Attributes
    ----------
    functions : mapping of str to callable
        Raw functions of the FMU.
    component : ctypes.c_void_p
        The instance.
    description : FmuDescription
        The FMU.
    """

    functions: FmiFunctions
    component: c_void_p
    description: FmuDescription

    def bind(self, action: str, *arguments: object) -> Callable[[], int]:
        """Return a function such as ``SetReal`` with its arguments in place.

        These are ctypes objects, or whole numbers for counts.
        """
        name = f"fmi{self.description.fmi_version}{action}"
        ready = (c_size_t(item) if isinstance(item, int) else item for item in arguments)
        return fixed_call(self.functions[name], self.component, *ready)


class Layout:
    """Where the values of some variables are in the buffer of a call, arrays being whole.

    Parameters
    ----------
    description : FmuDescription
        The FMU.
    names : sequence of str
        Variables in the order of the values.

    Attributes
    ----------
    references : ctypes array
        The variables of the call.
    size : int
        Number of values in the buffer.
    places : numpy.ndarray of int, shape (n,)
        Where the value of each name is in it.
    starts : mapping of int to int
        Where each array begins, by value reference.
    """

    def __init__(self, description: FmuDescription, names: Sequence[str]) -> None:
        begins: dict[int, int] = {}
        self.starts: dict[int, int] = {}
        self.size = 0
        places = []
        for storage in (description.storage[name] for name in names):
            if storage.reference not in begins:
                begins[storage.reference] = self.size
                self.size += storage.size
                if storage.reference in description.array_starts:
                    self.starts[storage.reference] = begins[storage.reference]
            places.append(begins[storage.reference] + storage.element)
        self.references: Any = (c_uint * len(begins))(*begins)
        self.places: Indices = np.array(places, np.intp)

    @property
    def is_plain(self) -> bool:
        """Whether the buffer is the values in their order, and nothing else."""
        return self.places.size == self.size and bool((np.diff(self.places) > 0).all())


class Group:
    """Variables of one type and the buffer of their values.

    Parameters
    ----------
    description : FmuDescription
        The FMU.
    names : sequence of str
        Variables of one type, numbers or Booleans.
    given : mapping of str to float, int, bool or str
        Start values: a buffer that holds whole arrays begins with what their elements are then.

    Attributes
    ----------
    arguments : tuple
        What the function gets after the instance.
    values : numpy.ndarray
        View of the buffer.
    places : slice or numpy.ndarray of int
        Where the value of each name is in it.
    """

    def __init__(
        self,
        description: FmuDescription,
        names: Sequence[str],
        given: Mapping[str, StartValue] | None = None,
    ) -> None:
        kind = description.storage[names[0]].kind
        layout = Layout(description, names)
        buffer = (kind.c_type * layout.size)()
        self.values: NDArray[Any] = np.frombuffer(buffer, dtype=np.dtype(kind.c_type))
        self.places: slice | Indices = slice(None) if layout.is_plain else layout.places
        counts = (buffer,) if description.fmi_version == 2 else (buffer, layout.size)
        self.arguments = (layout.references, len(layout.references), *counts)
        for reference, begin in layout.starts.items():
            start = description.array_starts[reference]
            self.values[begin : begin + len(start)] = start
        for name, value in (given or {}).items():
            storage = description.storage[name]
            if storage.reference in layout.starts:
                self.values[layout.starts[storage.reference] + storage.element] = value


def divide(
    description: FmuDescription, names: Sequence[str]
) -> list[tuple[str, list[str], slice | Indices]]:
    """Group names by type: function suffix, names, and their places among all names."""
    kinds = [description.storage[name].kind for name in names]
    groups = []
    for function in dict.fromkeys(kind.function for kind in kinds):
        places = [place for place, kind in enumerate(kinds) if kind.function == function]
        into = slice(None) if len(places) == len(names) else np.array(places, np.intp)
        groups.append((function, [names[place] for place in places], into))
    return groups


class Writer:
    """A fixed group of Real variables that are set together.

    Parameters
    ----------
    target : Target
        The FMU.
    names : sequence of str
        Variables in the order of the values.
    given : mapping of str to float, int, bool or str
        Start values, for the elements of arrays that are not among `names`.
    """

    def __init__(
        self, target: Target, names: Sequence[str], given: Mapping[str, StartValue] | None = None
    ) -> None:
        self._count = len(names)
        self._groups = []
        for function, members, source in divide(target.description, names):
            group = Group(target.description, members, given)
            call = target.bind(f"Set{function}", *group.arguments)
            self._groups.append((call, group.values, group.places, source))

    def write(self, values: Vector) -> int:
        """Set `values`, shape (n,), and return the FMI status."""
        for call, buffer, places, source in self._groups:
            buffer[places] = values[source]
            status = call()
            if status > 1:
                return status
        return 0

    def last(self) -> Vector:
        """Return the values set last, shape (n,)."""
        values = np.empty(self._count)
        for _, buffer, places, source in self._groups:
            values[source] = buffer[places]
        return values


class Reader:
    """A fixed group of numbers and Booleans that are read together.

    Parameters
    ----------
    target, names
        As for `Writer`.
    """

    def __init__(self, target: Target, names: Sequence[str]) -> None:
        self._groups = []
        for function, members, into in divide(target.description, names):
            group = Group(target.description, members)
            call = target.bind(f"Get{function}", *group.arguments)
            places = None if isinstance(group.places, slice) else group.places
            self._groups.append((call, group.values, places, into))

    def read(self, out: Vector) -> int:
        """Write the values to `out`, shape (n,), Booleans as 0 and 1; return the FMI status."""
        for call, buffer, places, into in self._groups:
            status = call()
            if status > 1:
                return status
            out[into] = buffer if places is None else buffer[places]
        return 0
