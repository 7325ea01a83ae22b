"""The sleepers around the flat on an endless track, out of those that pass by its window."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..signals import SIGNALS

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..scenario import Scenario


def show_sleepers(
    series: dict[str, NDArray[np.float64]], window: NDArray[np.float64], scenario: Scenario
) -> None:
    """Put the series of the same sleepers in one column, in place.

    Parameters
    ----------
    series : dict of str to ndarray
        Of `SIGNALS`; those of sleepers, of shape (n, sleepers), by place in the window.
        Afterwards they are those of the bays around the flat, zero while the window is elsewhere.
    window : ndarray, shape (n,)
        Where the window begins [m].
    scenario : Scenario
        What was run.
    """
    sleepers = scenario.track.bays - 1
    offset = np.rint(window / scenario.track.sleeper_spacing).astype(np.intp)
    starts = np.flatnonzero(np.diff(offset, prepend=offset[0] - 1))
    for signal in SIGNALS:
        if signal.dim != "sleeper" or signal.name not in series:
            continue
        shown = np.zeros_like(series[signal.name])
        for start, end in zip(starts, [*starts[1:], len(offset)], strict=True):
            ahead = scenario.first_bay - int(offset[start])
            first, last = max(0, -ahead), min(sleepers, sleepers - ahead)
            if first < last:
                places = slice(first + ahead, last + ahead)
                shown[start:end, first:last] = series[signal.name][start:end, places]
        series[signal.name] = shown
