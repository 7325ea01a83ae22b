"""The picture of a viscoelastic pad: hysteresis loops, and stiffnesses over its preload."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from .style import BLUE, OTHERS, QUIET, tidy

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..pad_curves import PadLoop


def draw_pad(loops: Sequence[PadLoop]) -> Figure:
    """Draw loops on the static curve, and dynamic and static stiffness.

    Parameters
    ----------
    loops : sequence of PadLoop
        By ascending preload.

    Returns
    -------
    matplotlib.figure.Figure
        Two panels; save it in the format wanted.
    """
    figure = Figure(figsize=(10.0, 4.5), layout="constrained")
    left, right = figure.subplots(1, 2)
    middles = [(float(np.mean(loop.deformation)), float(np.mean(loop.load))) for loop in loops]
    left.plot(*_scaled(np.array(middles)), "o:", color=QUIET, markersize=3, label="at rest")
    for number, loop in enumerate(loops):
        points = np.column_stack((loop.deformation, loop.load))
        label = "harmonic deformation" if number == 0 else None
        left.plot(*_scaled(points), color=BLUE, label=label)
    left.set_xlabel("compression beyond that by the clip [mm]")
    left.set_ylabel("load beyond the preload of the clip [kN]")
    preload = [1e-3 * loop.preload for loop in loops]
    for name, label, colour in (
        ("dynamic_stiffness", "dynamic", BLUE),
        ("static_stiffness", "static", OTHERS[0]),
    ):
        stiffness = [1e-6 * getattr(loop, name) for loop in loops]
        right.plot(preload, stiffness, "o-", color=colour, label=label)
    right.set_xlabel("preload [kN]")
    right.set_ylabel("stiffness [MN/m]")
    for axes in (left, right):
        tidy(axes)
    right.set_ylim(bottom=0.0)
    return figure


def _scaled(points: np.ndarray[tuple[int, int], np.dtype[np.float64]]) -> tuple[list[float], ...]:
    """Millimetres and kilonewtons of rows of metres and newtons."""
    return (1e3 * points[:, 0]).tolist(), (1e-3 * points[:, 1]).tolist()
