"""One row for every attempted step, and the counts that follow from them."""

import numpy as np
from numpy.typing import NDArray

from .decision import Candidate, Cause
from .outcome import Statistics
from .row_store import RowStore

row_type = np.dtype(
    [
        ("time", np.float64),
        ("step_size", np.float64),
        ("cause", np.int8),
        ("iterations", np.int32),
        ("error_norm", np.float64),
        ("residual_norm", np.float64),
    ]
)
"""Fields of a row; `cause` is 0 for accepted, else a `Cause`."""

chunk_size = 1024


class StepLog:
    """Collects rows cheaply, in bounded memory, and gives them as one structured array.

    Attributes
    ----------
    attempts : int
        Number of rows.
    step_size : float
        Size of the last attempt [s].
    """

    def __init__(self) -> None:
        self.attempts = 0
        self.step_size = 0.0
        self._counts = [0] * (len(Cause) + 1)
        self._iterations = 0
        self._rows: list[tuple[float, float, int, int, float, float]] = []
        self._store = RowStore(row_type)

    def append(self, candidate: Candidate, cause: int) -> None:
        """Add an attempt that was rejected for `cause`, or accepted if that is 0."""
        time, size, _, _, error, iterations, residual = candidate
        self.attempts += 1
        self.step_size = size
        self._counts[cause] += 1
        self._iterations += iterations
        self._rows.append((time, size, cause, iterations, error, residual))
        if len(self._rows) == chunk_size:
            self._keep()

    @property
    def accepted(self) -> int:
        """Number of accepted steps."""
        return self._counts[0]

    def as_array(self) -> NDArray[np.void]:
        """Return all rows, shape (n_attempts,), of type `row_type`."""
        self._keep()
        return self._store.as_array()

    def statistics(self, switches: int) -> Statistics:
        """Return the counts of a run with that many switches."""
        return Statistics(
            accepted=self._counts[0],
            rejected={cause.name.lower(): self._counts[cause] for cause in Cause},
            iterations=self._iterations,
            switches=switches,
        )

    def _keep(self) -> None:
        if self._rows:
            rows, self._rows = np.array(self._rows, dtype=row_type), []
            self._store.extend(rows)
