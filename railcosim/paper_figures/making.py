"""All figures with their captions, from what was calculated."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..figures.histories import draw_histories
from ..figures.load_displacement import draw_load_displacement
from ..figures.receptance import draw_receptance
from ..figures.speed import Points, draw_over_speed
from .captions import ballast_caption, histories_caption, peak_caption, receptance_caption
from .passages import BALLASTS

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import xarray as xr
    from matplotlib.figure import Figure

    from ..receptance.measured import MeasuredReceptance
    from ..scenario import Scenario
    from ..secant_data import SecantData
    from .measured_peaks import MeasuredPeaks

FORCE, MOMENT = "peak_contact_force", "peak_bending_moment_midspan"
"""Peak values that are drawn over the speed."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PaperFigure:
    """A figure with what is said under it.

    Attributes
    ----------
    name : str
        Name of its files without their endings.
    figure : matplotlib.figure.Figure
        The figure.
    caption : str
        A paragraph.
    """

    name: str
    figure: Figure
    caption: str


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Measured:
    """The user's measurements.

    Attributes
    ----------
    peaks : tuple of MeasuredPeaks
        Peak values over the speed.
    receptance : MeasuredReceptance, optional
        Receptance of the unloaded track at midspan.
    ballast : SecantData, optional
        Secant stiffness of the ballast over the load.
    """

    peaks: tuple[MeasuredPeaks, ...] = ()
    receptance: MeasuredReceptance | None = None
    ballast: SecantData | None = None


def receptance_figure(
    scenario: Scenario, receptance: xr.Dataset, measured: Measured
) -> PaperFigure:
    """Draw the receptance (Fig. 6)."""
    return PaperFigure(
        name="figure_6_receptance",
        figure=draw_receptance(receptance, measured.receptance),
        caption=receptance_caption(scenario, receptance, _given(measured.receptance)),
    )


def ballast_figure(curves: xr.Dataset, measured: Measured) -> PaperFigure:
    """Draw the load on the ballast over the displacement of the sleeper (Fig. 7)."""
    return PaperFigure(
        name="figure_7_load_displacement",
        figure=draw_load_displacement(curves, measured.ballast),
        caption=ballast_caption(curves, _given(measured.ballast)),
    )


def force_figure(scenario: Scenario, peaks: xr.Dataset, measured: Measured) -> PaperFigure:
    """Draw the peak contact force over the speed (Fig. 9)."""
    points = [Points(name=p.name, speed=p.speed, value=p.contact_force) for p in measured.peaks]
    return PaperFigure(
        name="figure_9_peak_contact_force",
        figure=draw_over_speed(peaks[FORCE], "peak contact force [kN]", points),
        caption=peak_caption(
            scenario, peaks, FORCE, "Peak contact force of the flat's wheel", _names(points)
        ),
    )


def moment_figure(scenario: Scenario, peaks: xr.Dataset, measured: Measured) -> PaperFigure:
    """Draw the peak bending moment over the speed (Fig. 10)."""
    points = [
        Points(name=p.name, speed=p.speed, value=p.bending_moment)
        for p in measured.peaks
        if p.bending_moment is not None
    ]
    what = "Peak bending moment of the rail in the middle of the struck bay, sagging positive,"
    return PaperFigure(
        name="figure_10_peak_bending_moment",
        figure=draw_over_speed(peaks[MOMENT], "peak bending moment [kN m]", points),
        caption=peak_caption(scenario, peaks, MOMENT, what, _names(points)),
    )


def histories_figure(
    scenario: Scenario, passages: Mapping[str, xr.Dataset], speed_kmh: float
) -> PaperFigure:
    """Draw the histories of a strike on both tracks."""
    return PaperFigure(
        name=f"histories_{speed_kmh:g}_kmh",
        figure=draw_histories(passages),
        caption=histories_caption(scenario, speed_kmh),
    )


def plain_numbers(peaks: xr.Dataset, receptance: xr.Dataset) -> dict[str, Any]:
    """Return what Figs 6, 9 and 10 show as plain numbers, SI units but for speeds in km/h."""
    tracks = {}
    for ballast in BALLASTS:
        one = peaks.sel(ballast=ballast)
        tracks[ballast] = {
            FORCE: one[FORCE].to_numpy().tolist(),
            MOMENT: one[MOMENT].to_numpy().tolist(),
            "max_sleeper_displacement": one["max_sleeper_displacement"].to_numpy().tolist(),
            "speed_kmh_of_largest_force": float(one[FORCE].idxmax("speed_kmh")),
            "speed_kmh_of_largest_moment": float(one[MOMENT].idxmax("speed_kmh")),
        }
    return {
        "resonance_frequencies": receptance["peak_frequency"].to_numpy().tolist(),
        "speed_kmh": peaks["speed_kmh"].to_numpy().tolist(),
        **tracks,
    }


def _names(points: Sequence[Points]) -> str | None:
    return ", ".join(point.name for point in points) or None


def _given(measured: object) -> str | None:
    return None if measured is None else "the user's"
