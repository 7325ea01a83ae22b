"""The points of a run around the flat's strike, out of all of them as they come."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..strike import WINDOW

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray


class StrikePoints:
    """Keeps every point in `WINDOW`, and the one before and after, which its ends lie between."""

    def __init__(self) -> None:
        self._parts: list[dict[str, NDArray[np.float64]]] = []

    def add(self, block: Mapping[str, NDArray[np.float64]], *, overlaps: bool) -> None:
        """Take the next points, in order.

        Parameters
        ----------
        block : mapping of str to ndarray, shape (n, ...)
            Series by name, ``distance`` among them.
        overlaps : bool
            Whether the first point is the last one of the points before.
        """
        distance = block["distance"]
        meets = (distance[1:] >= WINDOW[0]) & (distance[:-1] <= WINDOW[1])
        places = np.flatnonzero(meets)
        if places.size == 0:
            return
        known = overlaps and bool(self._parts) and places[0] == 0
        part = slice(places[0] + known, places[-1] + 2)
        self._parts.append({name: values[part].copy() for name, values in block.items()})

    def series(self, like: Mapping[str, NDArray[np.float64]]) -> dict[str, NDArray[np.float64]]:
        """Return what has been kept.

        Parameters
        ----------
        like : mapping of str to ndarray
            Any points, for the shape where nothing has been kept.
        """
        return {
            name: np.concatenate([part[name] for part in self._parts] or [values[:0]])
            for name, values in like.items()
        }
