"""Extremes of series over stretches of the way, from every step, while the run goes on."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from ..contact_loss import contact_losses
from ..signals import FORWARDS, labels

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from ..signals import Signal


@dataclass(slots=True, kw_only=True)
class _Stretch:
    """One stretch: by signal the largest and smallest value of every column; seconds per wheel."""

    largest: dict[str, NDArray[np.float64]]
    smallest: dict[str, NDArray[np.float64]]
    apart: NDArray[np.float64]


class Stretches:
    """Largest and smallest values between whole multiples of a length.

    Parameters
    ----------
    length : float
        Of a stretch [m].
    signals : sequence of Signal
        Whose extremes are wanted.
    end : float
        Where the run ends [m]: a point there belongs to the stretch before.
    """

    def __init__(self, length: float, signals: Sequence[Signal], *, end: float) -> None:
        self._length = length
        self._after = math.ceil(end / length - 1e-9)  # 0.3 is the third multiple of 0.1
        self._signals = signals
        self._found: dict[int, _Stretch] = {}

    def add(self, block: Mapping[str, NDArray[np.float64]], *, overlaps: bool) -> None:
        """Take the next points, in order.

        Parameters
        ----------
        block : mapping of str to ndarray
            ``distance`` of the flat's wheel [m] and ``time`` [s], shape (n,); every signal and
            ``gap``, shape (n, columns).
        overlaps : bool
            Whether the first point is the last one of the points before; the time between two
            points belongs to the stretch of the later one.
        """
        distance = block["distance"]
        number = np.floor(distance / self._length).astype(np.int64)
        number = np.minimum(number, self._after - 1)
        first = int(overlaps)
        starts = first + np.flatnonzero(np.diff(number[first:], prepend=number[first] - 1))
        for start, end in zip(starts, [*starts[1:], len(number)], strict=True):
            points = {signal.name: block[signal.name][start:end] for signal in self._signals}
            before = max(start - 1, 0)
            apart = [
                sum((b - a for a, b in contact_losses(block["time"][before:end], gap)), 0.0)
                for gap in block["gap"][before:end].T
            ]
            self._put(
                int(number[start]),
                _Stretch(
                    largest={name: values.max(axis=0) for name, values in points.items()},
                    smallest={name: values.min(axis=0) for name, values in points.items()},
                    apart=np.array(apart),
                ),
            )

    def _put(self, number: int, part: _Stretch) -> None:
        known = self._found.setdefault(number, part)
        if known is part:
            return
        for name in part.largest:
            np.maximum(known.largest[name], part.largest[name], out=known.largest[name])
            np.minimum(known.smallest[name], part.smallest[name], out=known.smallest[name])
        known.apart += part.apart

    def as_dataset(self) -> xr.Dataset:
        """Return what has been found.

        Returns
        -------
        xarray.Dataset
            Over ``stretch``, whose coordinate is where the stretches begin [m]: of every signal
            ``NAME_largest`` and ``NAME_smallest``, and ``time_without_contact`` of the wheels.
        """
        found = list(self._found.values())
        variables: dict[str, object] = {}
        for signal in self._signals:
            for word in ("largest", "smallest"):
                variables[f"{signal.name}_{word}"] = (
                    ("stretch", signal.dim),
                    np.stack([getattr(part, word)[signal.name] for part in found]),
                    labels(signal.units, f"{word} {signal.long_name} in the stretch", signal.sign),
                )
        variables["time_without_contact"] = (
            ("stretch", "wheel"),
            np.stack([part.apart for part in found]),
            labels("s", "time without contact in the stretch"),
        )
        begins = self._length * np.array(list(self._found), dtype=np.float64)
        meaning = "distance of the flat's wheel from the flat's centre where the stretch begins"
        coordinate = ("stretch", begins, labels("m", meaning, FORWARDS))
        return xr.Dataset(variables, coords={"stretch": coordinate})
