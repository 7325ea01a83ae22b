"""Inputs of an FMI 2.0 FMU on straight lines, by their standard derivatives."""

from collections.abc import Mapping, Sequence
from ctypes import c_double, c_int, c_uint

import numpy as np

from ..participant import Vector
from .description import StartValue
from .values import Indices, Reader, Target, Writer


class InputSlopes:
    """Turns inputs at the end of a step into their values and derivatives at its start.

    What FMI 2.0 sets before a step is the value at its start, so that nothing can be set before the
    size of the step is known. Inputs that are not continuous are set to their new value, and held.

    Parameters
    ----------
    target : Target
        The FMU.
    names : sequence of str
        Its inputs.
    given : mapping of str to float, int, bool or str
        Its start values.
    observed : sequence of str
        What is read at accepted points; an input among it is shown as it is at the end of a step.

    """

    def __init__(
        self,
        target: Target,
        names: Sequence[str],
        given: Mapping[str, StartValue],
        *,
        observed: Sequence[str],
    ) -> None:
        variables, storage = target.description.variables, target.description.storage
        continuous = [
            n for n, name in enumerate(names) if variables[name].variability == "continuous"
        ]
        sloped = [names[place] for place in continuous]
        self._start: Vector = np.zeros(len(names))
        self._end: Vector = np.zeros(len(names))
        self._places: Indices = np.array(continuous, np.intp)
        self._all = len(sloped) == len(names)
        self._reader = Reader(target, names)
        self._writer = Writer(target, names, given)
        count = len(sloped)
        references = (c_uint * count)(*(storage[name].reference for name in sloped))
        orders, slopes = (c_int * count)(*[1] * count), (c_double * count)()
        self._slopes: Vector = np.frombuffer(memoryview(slopes), np.float64)
        self._set_slopes = target.bind("SetRealInputDerivatives", references, count, orders, slopes)
        self._observed = Reader(target, observed)
        shown = [(n, names.index(name)) for n, name in enumerate(observed) if name in names]
        self._shown: Indices = np.array(shown, np.intp).reshape(-1, 2)
        self._values: Vector = np.zeros(len(names))

    @property
    def points(self) -> Vector:
        """Inputs at the start of the next step and those wanted at its end: part of a state.

        A new array of the shape (2, n).
        """
        return np.array((self._start, self._end))

    @points.setter
    def points(self, points: Vector) -> None:
        self._start[:], self._end[:] = points

    def begin(self) -> int:
        """Take the present inputs of the FMU as those at the start; return the FMI status."""
        status = self._reader.read(self._start)
        self._end[:] = self._start
        return status

    def aim(self, values: Vector) -> int:
        """Want `values`, shape (n,), at the end of the next step; return the FMI status."""
        self._end[:] = values
        return 0

    def write(self, step_size: float) -> int:
        """Set inputs and derivatives for a step of `step_size` [s]; return the FMI status."""
        start, end = self._start, self._end
        if self._all:
            np.subtract(end, start, out=self._slopes)
            status = self._writer.write(start)
        else:
            places = self._places
            np.subtract(end[places], start[places], out=self._slopes)
            self._values[:] = end
            self._values[places] = start[places]
            status = self._writer.write(self._values)
        np.divide(self._slopes, step_size, out=self._slopes)
        return status if status > 1 else self._set_slopes()

    def arrive(self) -> None:
        """Start the next step from where this one has ended."""
        self._start[:] = self._end

    def last(self) -> Vector:
        """Return the inputs wanted last, shape (n,)."""
        return self._end

    def read_observed(self, out: Vector) -> int:
        """Write the observed values to `out`, shape (n_observed,); return the FMI status."""
        status = self._observed.read(out)
        out[self._shown[:, 0]] = self._end[self._shown[:, 1]]
        return status
