"""Directional derivatives of an FMU, column by column."""

from collections.abc import Sequence
from ctypes import c_double

import numpy as np

from ..participant import Matrix, Vector
from .values import Layout, Target


class DirectionalDerivatives:
    """What each of some Real outputs gains with each of some Real inputs.

    Parameters
    ----------
    target : Target
        The FMU.
    inputs, outputs : sequence of str
        Variables in the order of columns and rows.
    """

    def __init__(self, target: Target, *, inputs: Sequence[str], outputs: Sequence[str]) -> None:
        description = target.description
        unknowns = Layout(description, outputs)
        result = (c_double * max(unknowns.size, 1))()
        self._values: Vector = np.frombuffer(memoryview(result), np.float64)
        self._rows = unknowns.places
        self._columns = []
        for name in inputs if outputs else ():
            known = Layout(description, [name])
            seed = (c_double * known.size)()
            seed[int(known.places[0])] = 1.0
            with_sizes = description.fmi_version > 2
            call = target.bind(
                "GetDirectionalDerivative",
                unknowns.references,
                len(unknowns.references),
                known.references,
                1,
                seed,
                *((known.size,) if with_sizes else ()),
                result,
                *((unknowns.size,) if with_sizes else ()),
            )
            self._columns.append(call)

    def read(self, out: Matrix) -> int:
        """Write the derivatives to `out`, shape (n_outputs, n_inputs); return the FMI status."""
        for column, call in enumerate(self._columns):
            status = call()
            if status > 1:
                return status
            out[:, column] = self._values[self._rows]
        return 0
