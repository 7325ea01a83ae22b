"""Time histories of chosen variables at the accepted points."""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from .errors import WiringError, close_matches
from .participant import Variable, Vector
from .row_store import RowStore
from .step_log import StepLog

chunk_rows, chunk_bytes = 1024, 2**20
"""Points that are collected before they are stored: so many, or fewer of so many bytes."""


class Recorder:
    """Observer that keeps time and values, in memory while they are few, else in a file.

    Parameters
    ----------
    names : sequence of str, optional
        ``participant.variable`` names; by default every numeric output of every participant.
    """

    def __init__(self, names: Sequence[str] | None = None) -> None:
        self._names: tuple[str, ...] | None = None if names is None else tuple(names)
        self.variables: Mapping[str, Variable] = {}
        self._columns: dict[str, int] = {}
        self._filled = self._capacity = 0
        self._begin(0)

    def choose(self, available: Mapping[str, Variable]) -> Sequence[str]:
        """Return the names given, or those of all numeric outputs."""
        if self._names is None:
            return [
                name
                for name, variable in available.items()
                if variable.causality == "output" and variable.type != "String"
            ]
        return self._names

    def start(self, variables: Mapping[str, Variable], _log: StepLog, /) -> None:
        """Begin anew."""
        chosen = list(self.choose(variables))
        places = {name: place for place, name in enumerate(variables)}
        self.variables = {name: variables[name] for name in chosen}
        self._columns = {name: column for column, name in enumerate(self.variables)}
        everything = list(self.variables) == list(variables)
        self._places = slice(None) if everything else [places[name] for name in self.variables]
        self._begin(len(self.variables))

    def accepted(self, time: float, values: Vector) -> None:
        """Keep a point."""
        filled = self._filled
        self._times[filled] = time
        self._rows[filled] = values[self._places]
        self._filled = filled + 1
        if self._filled == self._capacity:
            self._store_points()

    def finished(self) -> None:
        """Nothing is left to do."""

    @property
    def time(self) -> Vector:
        """Accepted times [s], shape (n_points,)."""
        return self._points()["time"]

    @property
    def values(self) -> Vector:
        """Values at these times, shape (n_points, n_variables)."""
        return self._points()["values"]

    def __getitem__(self, name: str) -> Vector:
        """Return the history of one variable, shape (n_points,)."""
        if name not in self._columns:
            raise WiringError(f"{name!r} was not recorded; {close_matches(name, self._columns)}.")
        return self.values[:, self._columns[name]]

    def _begin(self, width: int) -> None:
        row_type = np.dtype([("time", np.float64), ("values", np.float64, (width,))])
        self._store = RowStore(row_type)
        self._filled = 0
        self._capacity = max(2, min(chunk_rows, chunk_bytes // row_type.itemsize))
        self._buffer = np.empty(self._capacity, row_type)
        self._times: Vector = self._buffer["time"]
        self._rows: Vector = self._buffer["values"]

    def _store_points(self) -> None:
        filled, self._filled = self._filled, 0
        self._store.extend(self._buffer[:filled])

    def _points(self) -> NDArray[np.void]:
        if self._filled:
            self._store_points()
        return self._store.as_array()


class LastPoint(Recorder):
    """Recorder that keeps the last point only, for runs whose histories nobody wants."""

    def accepted(self, time: float, values: Vector) -> None:
        """Keep a point in place of the one before."""
        self._filled = 0
        super().accepted(time, values)

    def _points(self) -> NDArray[np.void]:
        return self._buffer[: self._filled]
