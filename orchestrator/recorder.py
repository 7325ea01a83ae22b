"""Time histories of chosen variables at the accepted points."""

from collections.abc import Mapping, Sequence

import numpy as np

from .errors import WiringError, close_matches
from .participant import Variable, Vector
from .step_log import StepLog

first_capacity = 1024


class Recorder:
    """Observer that keeps time and values.

    Parameters
    ----------
    names : sequence of str, optional
        ``participant.variable`` names; by default every numeric output of every participant.
    """

    def __init__(self, names: Sequence[str] | None = None) -> None:
        self._names: tuple[str, ...] | None = None if names is None else tuple(names)
        self.variables: Mapping[str, Variable] = {}
        self._columns: dict[str, int] = {}
        self._count = 0
        self._time: Vector = np.empty(0)
        self._values: Vector = np.empty((0, 0))

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
        self._count = 0
        self._time = np.empty(first_capacity)
        self._values = np.empty((first_capacity, len(self.variables)))

    def accepted(self, time: float, values: Vector) -> None:
        """Keep a point."""
        if self._count == self._time.size:
            self._time = np.concatenate([self._time, np.empty_like(self._time)])
            self._values = np.concatenate([self._values, np.empty_like(self._values)])
        self._time[self._count] = time
        self._values[self._count] = values[self._places]
        self._count += 1

    def finished(self) -> None:
        """Nothing is left to do."""

    @property
    def time(self) -> Vector:
        """Accepted times [s], shape (n_points,)."""
        return self._time[: self._count]

    @property
    def values(self) -> Vector:
        """Values at these times, shape (n_points, n_variables)."""
        return self._values[: self._count]

    def __getitem__(self, name: str) -> Vector:
        """Return the history of one variable, shape (n_points,)."""
        if name not in self._columns:
            raise WiringError(f"{name!r} was not recorded; {close_matches(name, self._columns)}.")
        return self.values[:, self._columns[name]]
