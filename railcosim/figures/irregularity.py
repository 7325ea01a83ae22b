"""The picture of what rail and wheels are uneven by: over the way, over wavelength, over angle."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from ..irregularity.bands import band_levels
from ..irregularity.spectra import ISO3095_LIMIT, band_wavelengths
from .style import BLUE, OTHERS, QUIET, tidy

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from vehicle_fmu.irregularity import RailIrregularity
    from vehicle_fmu.out_of_roundness import OutOfRoundness

    from ..scenario import Scenario
    from ..surfaces.tables import UnevenSurfaces

HEIGHT = 2.8
"""Of a panel [inch]."""


def draw_surfaces(scenario: Scenario, surfaces: UnevenSurfaces) -> Figure:
    """Draw the drop of the rail, its one-third octaves, and the drop of the treads.

    Parameters
    ----------
    scenario : Scenario
        Says where the wheels run.
    surfaces : UnevenSurfaces
        Composed of it, and uneven.

    Returns
    -------
    matplotlib.figure.Figure
        Two panels for the rail, one for the wheels, each where there is something to show.
    """
    panels = 2 * (surfaces.rail is not None) + bool(surfaces.treads)
    figure = Figure(figsize=(8.0, HEIGHT * panels), layout="constrained")
    axes = list(figure.subplots(panels, 1, squeeze=False)[:, 0])
    if surfaces.rail is not None:
        _draw_rail(axes[0], surfaces.rail)
        _draw_levels(axes[1], surfaces.rail, scenario)
    if surfaces.treads:
        _draw_treads(axes[-1], surfaces.treads)
    return figure


def _draw_rail(axes: Axes, rail: RailIrregularity) -> None:
    axes.plot(rail.position, 1e6 * rail.drop, color=BLUE, linewidth=0.8)
    axes.set_xlabel("position along the rail [m]")
    axes.set_ylabel("drop of the rail [µm]")
    axes.invert_yaxis()
    tidy(axes, legend=False)


def _draw_levels(axes: Axes, rail: RailIrregularity, scenario: Scenario) -> None:
    """Draw the levels behind the onset beside the limit of rail roughness."""
    whole = rail.position >= rail.position[0] + scenario.surface.ramp
    position, drop = rail.position[whole], rail.drop[whole]
    even = np.linspace(position[0], position[-1], position.size)
    wavelength, level = band_levels(np.interp(even, position, drop), float(even[1] - even[0]))
    shown = np.isfinite(level) & (level > level.max() - 80.0)
    axes.semilogx(
        100.0 * wavelength[shown], level[shown], "o-", color=BLUE, markersize=3, label="rail"
    )
    axes.semilogx(
        100.0 * band_wavelengths(), ISO3095_LIMIT, "--", color=QUIET, label="limit of ISO 3095:2013"
    )
    axes.invert_xaxis()
    axes.set_xlabel("wavelength [cm]")
    axes.set_ylabel("level [dB re 1 µm]")
    tidy(axes)


def _draw_treads(axes: Axes, treads: tuple[OutOfRoundness | None, ...]) -> None:
    for number, tread in enumerate(treads, start=1):
        if tread is not None:
            colour = (BLUE, *OTHERS)[(number - 1) % (1 + len(OTHERS))]
            angle = np.rad2deg(tread.angle)
            axes.plot(angle, 1e6 * tread.drop, color=colour, linewidth=0.8, label=f"wheel {number}")
    axes.set_xlabel("angle around the wheel [deg]")
    axes.set_ylabel("drop of the tread [µm]")
    axes.invert_yaxis()
    tidy(axes)
