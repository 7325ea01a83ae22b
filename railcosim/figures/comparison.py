"""Results laid over their baselines where they differ."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from ..comparison.polyline import Polyline
from .style import BLUE, OTHERS, QUIET, tidy

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from ..comparison.comparison import Comparison, SignalComparison
    from ..comparison.recording import Recording

MOST = 8
"""Signals in one figure."""

SURROUNDINGS = 0.02
"""Part of the compared interval that is shown to each side of the largest difference."""

TUBE_POINTS = 2000
"""Times at which the edge of a tube is drawn."""


def draw_comparison(
    result: Recording,
    baseline: Recording,
    comparison: Comparison,
    signals: Sequence[SignalComparison],
) -> Figure:
    """Draw signals over their baselines with the tube, whole and near the largest excess.

    Parameters
    ----------
    result, baseline : Recording
        What was compared.
    comparison : Comparison
        What came of it.
    signals : sequence of SignalComparison
        What to draw, `MOST` at most: the first ones of a longer sequence.

    Returns
    -------
    matplotlib.figure.Figure
        Two panels a signal; a signal with values that are not finite has gaps there.
    """
    drawn = signals[:MOST]
    figure = Figure(figsize=(11.0, 2.8 * len(drawn)), layout="constrained")
    grid = figure.subplots(len(drawn), 2, squeeze=False, width_ratios=(2.0, 1.0))
    for signal, (whole, near) in zip(drawn, grid, strict=True):
        for axes, span in (
            (whole, comparison.interval),
            (near, _surroundings(signal, comparison.interval)),
        ):
            _draw(axes, (result, baseline), signal, span)
            tidy(axes)
            axes.set_xlabel("time [s]")
        whole.set_ylabel(f"{signal.name} [{signal.unit or '1'}]")
        near.get_legend().remove()
    more = len(signals) - len(drawn)
    title = f"{comparison.result} over {comparison.baseline}"
    figure.suptitle(f"{title} ({more} more differ)" if more else title, fontsize="medium")
    return figure


def _surroundings(signal: SignalComparison, interval: tuple[float, float]) -> tuple[float, float]:
    """Return where the signal leaves the tube farthest, and a little more."""
    if signal.measures is None:
        return interval
    half = max(SURROUNDINGS * (interval[1] - interval[0]), 2.0 * signal.time_tolerance)
    time = signal.measures.excess_time
    return max(time - half, interval[0]), min(time + half, interval[1])


def _draw(
    axes: Axes,
    recordings: tuple[Recording, Recording],
    signal: SignalComparison,
    span: tuple[float, float],
) -> None:
    """Draw the tube, the result and the baseline in a span of time [s]."""
    result, baseline = recordings
    held = baseline.series[signal.name].held
    seen = []
    for recording, word, colour, width in (
        (baseline, "baseline", BLUE, 1.8),
        (result, "result", OTHERS[0], 1.0),
    ):
        times, values = recording.times, recording.series[signal.name].values.astype(float)
        style = "steps-post" if held else "default"
        axes.plot(times, values, label=word, color=colour, linewidth=width, drawstyle=style)
        seen.append(values[(times >= span[0]) & (times <= span[1]) & np.isfinite(values)])
    if signal.measures is not None and np.isfinite(signal.allowed):
        times, lower, upper = _tube(baseline, signal, span)
        axes.fill_between(times, lower, upper, color=QUIET, alpha=0.3, linewidth=0.0, label="tube")
    axes.set_xlim(*span)
    values = np.concatenate(seen)
    if values.size:
        margin = 0.05 * float(np.ptp(values)) or 0.05 * float(np.abs(values).max()) or 1.0
        axes.set_ylim(float(values.min()) - margin, float(values.max()) + margin)


def _tube(
    baseline: Recording, signal: SignalComparison, span: tuple[float, float]
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Return the lower and the upper edge of the tube over the time."""
    series = baseline.series[signal.name]
    line = Polyline.through(baseline.times, series.values, held=series.held)
    times = np.linspace(*span, TUBE_POINTS)
    lowest, highest = line.extremes(times, signal.time_tolerance)
    return times, lowest - signal.allowed, highest + signal.allowed
