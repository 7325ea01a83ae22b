"""What it takes to repeat the attempt on which a run ended."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LastAttempt:
    """An attempt, and the accepted point from which it started.

    Attributes
    ----------
    time, step_size : float
        Start and size of the step [s].
    landing : float or None
        The exact time at its end, where that is on the grid or the stop time.
    values : numpy.ndarray, shape (n_values,)
        Exchanged values at the start.
    slope : numpy.ndarray or None, shape (n_values,)
        Their slope, from which they were predicted.
    jacobians : sequence of numpy.ndarray or None
        What the coupling knew of each block.
    indicators : sequence of float
        Event indicators at the start.
    states : mapping of str to bytes
        Serialised state of every participant at the start.
    """

    time: float
    step_size: float
    landing: float | None
    values: NDArray[np.float64]
    slope: NDArray[np.float64] | None
    jacobians: Sequence[NDArray[np.float64] | None]
    indicators: Sequence[float]
    states: Mapping[str, bytes]
