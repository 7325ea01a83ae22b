"""Inputs and outputs as they were last exchanged with the process of an isolated FMU."""

from collections.abc import Sequence

import numpy as np

from .frames import Operation, Report
from .participant import Vector


class ExchangedValues:
    """The inputs given last, and the outputs as long as they are those of the present state.

    Parameters
    ----------
    inputs : sequence of str
        Names of the bound inputs.

    Attributes
    ----------
    outputs : (n_outputs,) float array or None
        None where they have to be asked for.
    """

    def __init__(self, inputs: Sequence[str]) -> None:
        self.outputs: Vector | None = None
        self._names = tuple(inputs)
        self._inputs = np.zeros(len(self._names))

    def give(self, values: Vector) -> bytes:
        """Keep new inputs, shape (n_inputs,), and return the operation that sets them."""
        self._inputs[:] = values
        self.forget()
        return bytes([Operation.SET_INPUTS]) + self._inputs.tobytes()

    def take(self, report: Report) -> None:
        """Keep the outputs in a report."""
        self.outputs = np.frombuffer(report.payload)

    def forget(self) -> None:
        """Give up the outputs: they are of a state that has been left."""
        self.outputs = None

    def named_inputs(self) -> dict[str, float]:
        """Return the inputs by name."""
        return dict(zip(self._names, self._inputs.tolist(), strict=True))
