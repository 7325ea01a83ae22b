"""Reading and writing groups of FMU variables: one call per type and nothing allocated."""

from collections.abc import Callable, Mapping, Sequence
from ctypes import c_char_p, c_double, c_int, c_size_t, c_uint, c_void_p
from typing import Any

import numpy as np

from .fixed_call import fixed_call
from .fmu_description import FmuDescription, StartValue
from .participant import Matrix, Vector

FmiFunctions = Mapping[str, Callable[..., Any]]
"""Raw functions of the shared library by FMI name."""

storage: Mapping[str, tuple[str, Any]] = {
    "Real": ("Real", c_double),
    "Integer": ("Integer", c_int),
    "Enumeration": ("Integer", c_int),
    "Boolean": ("Boolean", c_int),
    "String": ("String", c_char_p),
}
"""FMI function suffix and C type of each variable type."""


class Writer:
    """A fixed group of Real variables that are set together.

    Parameters
    ----------
    functions : mapping of str to callable
        Raw functions of the FMU.
    component : ctypes.c_void_p
        The instance.
    description : FmuDescription
        The FMU.
    names : sequence of str
        Variables in the order of the values.
    """

    def __init__(
        self,
        functions: FmiFunctions,
        component: c_void_p,
        description: FmuDescription,
        names: Sequence[str],
    ) -> None:
        self._count = len(names)
        buffer = (c_double * max(len(names), 1))()
        self._view: Vector = np.frombuffer(memoryview(buffer), np.float64, len(names))
        self._set = fixed_call(
            functions["fmi2SetReal"],
            component,
            references(description, names),
            c_size_t(len(names)),
            buffer,
        )

    def write(self, values: Vector) -> int:
        """Set `values`, shape (n,), and return the FMI status."""
        if self._count == 0:
            return 0
        self._view[:] = values
        return self._set()

    def last(self) -> list[float]:
        """Return the values set last."""
        values: list[float] = self._view.tolist()
        return values


class Reader:
    """A fixed group of Real, Integer and Boolean variables that are read together.

    Parameters
    ----------
    functions, component, description, names
        As for `Writer`.
    """

    def __init__(
        self,
        functions: FmiFunctions,
        component: c_void_p,
        description: FmuDescription,
        names: Sequence[str],
    ) -> None:
        kinds = [storage[description.variables[name].type] for name in names]
        self._groups: list[tuple[Callable[[], int], Vector, Any]] = []
        for kind in dict.fromkeys(kinds):
            suffix, c_type = kind
            places = [place for place, other in enumerate(kinds) if other == kind]
            buffer = (c_type * len(places))()
            get = fixed_call(
                functions[f"fmi2Get{suffix}"],
                component,
                references(description, [names[place] for place in places]),
                c_size_t(len(places)),
                buffer,
            )
            view = np.frombuffer(buffer, dtype=np.dtype(c_type))
            where = slice(None) if len(places) == len(names) else np.array(places)
            self._groups.append((get, view, where))

    def read(self, out: Vector) -> int:
        """Write the values to `out`, shape (n,), Booleans as 0 and 1; return the FMI status."""
        for get, view, places in self._groups:
            status = get()
            if status > 1:
                return status
            out[places] = view
        return 0


class DirectionalDerivatives:
    """What each of some Real outputs gains with each of some Real inputs.

    Parameters
    ----------
    functions, component, description
        As for `Writer`.
    inputs, outputs : sequence of str
        Variables in the order of columns and rows.
    """

    def __init__(
        self,
        functions: FmiFunctions,
        component: c_void_p,
        description: FmuDescription,
        *,
        inputs: Sequence[str],
        outputs: Sequence[str],
    ) -> None:
        self._get = functions["fmi2GetDirectionalDerivative"]
        self._component = component
        self._unknowns = references(description, outputs)
        self._knowns = [references(description, [name]) for name in inputs]
        self._seed = (c_double * 1)(1.0)
        self._buffer = (c_double * max(len(outputs), 1))()
        self._view: Vector = np.frombuffer(memoryview(self._buffer), np.float64, len(outputs))

    def read(self, out: Matrix) -> int:
        """Write the derivatives to `out`, shape (n_outputs, n_inputs); return the FMI status."""
        count = self._view.size
        for column, known in enumerate(self._knowns if count else ()):
            status: int = self._get(
                self._component, self._unknowns, count, known, 1, self._seed, self._buffer
            )
            if status > 1:
                return status
            out[:, column] = self._view
        return 0


def write_start_values(
    functions: FmiFunctions,
    component: c_void_p,
    description: FmuDescription,
    values: Mapping[str, StartValue],
) -> tuple[str, int]:
    """Set start values of any type one by one.

    Returns
    -------
    name : str
        The first variable that was refused, or ``""``.
    status : int
        The FMI status of that.
    """
    for name, value in values.items():
        suffix, c_type = storage[description.variables[name].type]
        raw = value.encode() if isinstance(value, str) else value
        status = functions[f"fmi2Set{suffix}"](
            component, references(description, [name]), 1, (c_type * 1)(raw)
        )
        if status > 1:
            return name, status
    return "", 0


def references(description: FmuDescription, names: Sequence[str]) -> Any:  # noqa: ANN401
    """Return the value references of `names` as a C array."""
    return (c_uint * len(names))(*(description.references[name] for name in names))
