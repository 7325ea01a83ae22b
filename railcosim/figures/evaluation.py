"""Pictures of an evaluation."""

from __future__ import annotations

from itertools import cycle
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter, ScalarFormatter

from ..evaluation.settings import PartName
from .style import BLUE, OTHERS, QUIET, tidy

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    import xarray as xr
    from matplotlib.axes import Axes

OVERVIEW = (PartName.SPECTRUM, PartName.THIRD_OCTAVES, PartName.DETECTOR, PartName.SUPPORTS)
"""Parts that a picture of everything shows."""


def draw_evaluation(evaluation: xr.Dataset, part: PartName | None, title: str) -> Figure:
    """Draw a part of an evaluation, or four of them.

    Parameters
    ----------
    evaluation : xarray.Dataset
        From `evaluation.parts.evaluate`, of that part or of all.
    part : PartName, optional
        Which part; four of them without.
    title : str
        Which passage it was.

    Returns
    -------
    matplotlib.figure.Figure
        Save it in the format wanted.
    """
    parts = OVERVIEW if part is None else (part,)
    figure = Figure(figsize=(8.0, 3.6 * len(parts)), layout="constrained")
    panels = figure.subplots(len(parts), 1, squeeze=False).ravel()
    for name, axes in zip(parts, panels, strict=True):
        DRAWERS[name](evaluation, axes)
        tidy(axes)
    figure.suptitle(title)
    return figure


def _wheels(evaluation: xr.Dataset) -> Iterator[tuple[xr.Dataset, str, str]]:
    """Yield the part of every wheel, its label and its colour."""
    colours = cycle((BLUE, *OTHERS))
    for wheel in evaluation["wheel"].to_numpy():
        yield evaluation.sel(wheel=wheel), f"wheel {wheel}", next(colours)


def _draw_loads(evaluation: xr.Dataset, axes: Axes) -> None:
    numbers = evaluation["wheel"].to_numpy()
    axes.bar(numbers, evaluation["dynamic_factor"], width=0.5, color=BLUE, label="dynamic factor")
    axes.axhline(1.0, color=QUIET, linestyle="--", linewidth=1.0, label="static")
    axes.set_xticks(numbers)
    axes.set_xlabel("wheel")
    axes.set_ylabel("largest over static contact force")


def _draw_spectrum(evaluation: xr.Dataset, axes: Axes) -> None:
    for one, label, colour in _wheels(evaluation):
        amplitude = 1e-3 * one["contact_force_amplitude"]
        axes.loglog(evaluation["frequency"], amplitude, color=colour, label=label)
    axes.set_xlabel("frequency [Hz]")
    axes.set_ylabel("amplitude of the\ncontact force [kN]")


def _draw_bands(evaluation: xr.Dataset, axes: Axes) -> None:
    _draw_levels(evaluation, axes, "contact_force_band", "band_frequency")
    axes.set_xlabel("midband frequency [Hz]")


def _draw_wavelengths(evaluation: xr.Dataset, axes: Axes) -> None:
    _draw_levels(evaluation, axes, "contact_force_wavelength_band", "band_wavelength")
    axes.invert_xaxis()
    axes.set_xlabel("midband wavelength [m]")


def _draw_levels(evaluation: xr.Dataset, axes: Axes, name: str, along: str) -> None:
    for one, label, colour in _wheels(evaluation):
        band = one[name].where(one[name] > 0.0)
        level = 20.0 * np.log10(band)
        axes.plot(evaluation[along], level, "o-", color=colour, label=label, markersize=3.5)
    axes.set_xscale("log")
    axes.set_xticks(evaluation[along].to_numpy()[::3])
    axes.set_xticklabels([f"{value:g}" for value in _names(evaluation, along)[::3]])
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.yaxis.set_major_formatter(ScalarFormatter())
    axes.set_ylabel("contact force in the band\n[dB re 1 N]")


def _names(evaluation: xr.Dataset, along: str) -> list[float]:
    names: list[float] = evaluation[along.replace("band_", "nominal_")].to_numpy().tolist()
    return names


def _draw_detector(evaluation: xr.Dataset, axes: Axes) -> None:
    named = set()
    for bay in evaluation["bay"].to_numpy():
        force = 1e-3 * evaluation["bay_force"].sel(bay=bay)
        word, colour = ("even bays", BLUE) if bay % 2 == 0 else ("odd bays", OTHERS[0])
        axes.plot(
            evaluation["record_time"],
            force.where(force > 0.0),
            color=colour,
            label=None if word in named else word,
            linewidth=1.0,
        )
        named.add(word)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("force that the load\ndetector reads [kN]")


def _draw_bays(evaluation: xr.Dataset, axes: Axes) -> None:
    for one, label, colour in _wheels(evaluation):
        bays = evaluation["bay"]
        largest, mean = 1e-3 * one["bay_max_force"], 1e-3 * one["bay_mean_force"]
        axes.plot(bays, largest, "o-", color=colour, label=f"{label}, largest")
        axes.plot(bays, mean, "--", color=colour, label=f"{label}, mean", linewidth=1.0)
    axes.set_xlabel("bay")
    axes.set_ylabel("contact force [kN]")


def _draw_gauges(evaluation: xr.Dataset, axes: Axes) -> None:
    colours = cycle((BLUE, *OTHERS))
    for gauge in evaluation["gauge"].to_numpy():
        one = evaluation.sel(gauge=gauge)
        label = f"gauge at {float(one['gauge_position']):.3f} m"
        axes.plot(evaluation["time"], 1e6 * one["strain"], color=next(colours), label=label)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("strain [$10^{-6}$]")


def _draw_supports(evaluation: xr.Dataset, axes: Axes) -> None:
    place = evaluation["sleeper_position"]
    axes.plot(place, 1e-3 * evaluation["max_pad_force"], "o-", color=BLUE, label="rail pad")
    axes.plot(place, 1e-3 * evaluation["max_ballast_force"], "s-", color=OTHERS[0], label="ballast")
    axes.set_xlabel("position of the sleeper [m]")
    axes.set_ylabel("largest force [kN]")


DRAWERS: Mapping[PartName, Callable[[xr.Dataset, Axes], None]] = {
    PartName.WHEELS: _draw_loads,
    PartName.SPECTRUM: _draw_spectrum,
    PartName.THIRD_OCTAVES: _draw_bands,
    PartName.WAVELENGTHS: _draw_wavelengths,
    PartName.DETECTOR: _draw_detector,
    PartName.BAYS: _draw_bays,
    PartName.GAUGES: _draw_gauges,
    PartName.SUPPORTS: _draw_supports,
}
"""How every part is drawn."""
