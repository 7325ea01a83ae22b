"""Peak values over the speed of the train, on both tracks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure
from numpy.polynomial import Polynomial

from .style import BLUE, OTHERS, tidy

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray as xr
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

ORDER = 5
"""Of the polynomials that are fitted to peak values."""

FEWEST_SPEEDS = ORDER + 2
"""Speeds from which on a polynomial is fitted and not just laid through the points."""

MARKERS = {"state_dependent": ("s", BLUE), "linear": ("o", OTHERS[0])}
"""Marker and colour of either track."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Points:
    """Measured points.

    Attributes
    ----------
    name : str
        What they are called.
    speed : ndarray, shape (n,)
        Speeds [km/h].
    value : ndarray, shape (n,)
        What was measured, in the unit of what is drawn.
    """

    name: str
    speed: NDArray[np.float64]
    value: NDArray[np.float64]


def draw_over_speed(peaks: xr.DataArray, label: str, measured: Sequence[Points] = ()) -> Figure:
    """Draw peak values over the speed with polynomials of fifth order fitted to them.

    Parameters
    ----------
    peaks : xarray.DataArray
        Calculated peaks, dims (speed_kmh, ballast).
    label : str
        What they are, with a unit a thousand times theirs.
    measured : sequence of Points
        Measured peaks in the same unit.

    Returns
    -------
    matplotlib.figure.Figure
        Squares for the state-dependent track, circles for the linear one, asterisks for what was
        measured, each with its polynomial where there are `FEWEST_SPEEDS`.
    """
    figure = Figure(figsize=(8.0, 5.5), layout="constrained")
    axes = figure.subplots()
    for ballast, (marker, colour) in MARKERS.items():
        one = peaks.sel(ballast=ballast)
        speed, value = one["speed_kmh"].to_numpy(), 1e-3 * one.to_numpy()
        name = f"{ballast.replace('_', '-')} track"
        axes.plot(speed, value, marker, color=colour, fillstyle="none", label=name)
        _draw_fit(axes, speed, value, colour)
    for points, colour in zip(measured, ("black", *OTHERS[1:]) * len(measured), strict=False):
        axes.plot(points.speed, 1e-3 * points.value, "*", color=colour, label=points.name)
        _draw_fit(axes, points.speed, 1e-3 * points.value, colour)
    axes.set_xlabel("speed [km/h]")
    axes.set_ylabel(label)
    tidy(axes)
    axes.set_xlim(0.0, 1.03 * axes.dataLim.x1)
    return figure


def fit(speed: NDArray[np.float64], value: NDArray[np.float64]) -> Polynomial | None:
    """Fit a polynomial of fifth order by least squares.

    Returns
    -------
    numpy.polynomial.Polynomial or None
        None for fewer than `FEWEST_SPEEDS` different speeds.
    """
    if np.unique(speed).size < FEWEST_SPEEDS:
        return None
    return Polynomial.fit(speed, value, ORDER)


def _draw_fit(
    axes: Axes, speed: NDArray[np.float64], value: NDArray[np.float64], colour: str
) -> None:
    polynomial = fit(speed, value)
    if polynomial is not None:
        x, y = polynomial.linspace(300)
        axes.plot(x, y, color=colour, linewidth=1.0)
