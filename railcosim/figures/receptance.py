"""The picture of a receptance: amplitude and phase over frequency."""

from __future__ import annotations

from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from .style import BLUE, OTHERS, QUIET, tidy

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

    from ..receptance.measured import MeasuredReceptance


def draw_receptance(receptance: xr.Dataset, measured: MeasuredReceptance | None = None) -> Figure:
    """Draw a calculated receptance, with a measured one over it where there is one.

    Parameters
    ----------
    receptance : xarray.Dataset
        As `railcosim.receptance.dataset.compute_receptance` returns it, also read from a file.
    measured : MeasuredReceptance, optional
        Drawn as points.

    Returns
    -------
    matplotlib.figure.Figure
        Amplitude above phase; save it in the format wanted.
    """
    figure = Figure(figsize=(8.0, 7.0), layout="constrained")
    amplitude, phase = figure.subplots(2, 1, sharex=True, height_ratios=(3, 2))
    _draw_calculated(amplitude, phase, receptance)
    if measured is not None:
        _draw_measured(amplitude, phase, measured)
    amplitude.set_xscale("log")
    amplitude.set_yscale("log")
    amplitude.set_ylabel("displacement over force [m/N]")
    phase.set_ylabel("phase [deg]")
    phase.set_yticks(range(-180, 181, 45))
    lowest, highest = phase.dataLim.intervaly
    phase.set_ylim(min(-180.0, lowest), max(0.0, highest))
    phase.set_xlabel("frequency [Hz]")
    tidy(amplitude)
    tidy(phase, legend=False)
    figure.suptitle(_describe(receptance))
    return figure


def _describe(receptance: xr.Dataset) -> str:
    """Say what was loaded and observed."""
    attributes = receptance.attrs
    load, response = attributes["load"], attributes["response"]
    where = load if load == response else f"force: {load}, displacement: {response}"
    preload = attributes["preload"]
    state = f"under a preload of {1e-3 * preload:g} kN" if preload else "unloaded track"
    return f"receptance, {where}, {state}"


def _draw_calculated(amplitude: Axes, phase: Axes, receptance: xr.Dataset) -> None:
    """Draw every method, the first one as the line that counts, and name the resonances."""
    frequency = receptance["frequency"].to_numpy()
    styles = ((BLUE, "-"), (OTHERS[0], "--"))
    methods = [str(name) for name in receptance["solution"].to_numpy()]
    for name, (colour, line) in zip(methods, styles, strict=False):
        curve = receptance.sel(solution=name)
        amplitude.plot(frequency, curve["amplitude"], line, color=colour, label=name)
        phase.plot(frequency, curve["phase"], line, color=colour)
    for peak in range(receptance.sizes["peak"]):
        at = float(receptance["peak_frequency"][peak])
        top = float(receptance["peak_amplitude"][peak])
        amplitude.annotate(
            f"{at:.0f} Hz", (at, top), xytext=(0, 4), textcoords="offset points", ha="center"
        )
        for axes in (amplitude, phase):
            axes.axvline(at, color=QUIET, linewidth=0.6, linestyle=":", zorder=0)


def _draw_measured(amplitude: Axes, phase: Axes, measured: MeasuredReceptance) -> None:
    """Draw measured points."""
    dots = "k."
    amplitude.plot(
        measured.frequency, measured.amplitude, dots, markersize=3, zorder=1, label="measured"
    )
    if measured.phase is not None:
        turned = (measured.phase + 180.0) % 360.0 - 180.0  # as the calculated one
        phase.plot(measured.frequency, turned, dots, markersize=3, zorder=1)
