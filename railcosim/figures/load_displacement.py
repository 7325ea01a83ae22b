"""The picture of ballast that stiffens: load over sleeper displacement."""

from __future__ import annotations

from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from .style import BLUE, OTHERS, QUIET, tidy

if TYPE_CHECKING:
    import xarray as xr

    from ..secant_data import SecantData


def draw_load_displacement(curves: xr.Dataset, measured: SecantData | None = None) -> Figure:
    """Draw the state-dependent and the linear ballast, the law they stand for and measured points.

    Parameters
    ----------
    curves : xarray.Dataset
        As `railcosim.ballast_curves.compute_curves` returns it.
    measured : SecantData, optional
        Drawn as dots.

    Returns
    -------
    matplotlib.figure.Figure
        One panel; save it in the format wanted.
    """
    figure = Figure(figsize=(8.0, 5.5), layout="constrained")
    axes = figure.subplots()
    x = 1e3 * curves["displacement"].to_numpy()
    for name, label, style, colour in (
        ("force_polynomial", "polynomial, Eq. (27)", "-", BLUE),
        ("force_ballast", "the scenario's", "-", BLUE),
        ("force_fitted", "polynomial fitted to the markers", "--", OTHERS[0]),
        ("force_linear", "linear", ":", QUIET),
    ):
        if name in curves:
            axes.plot(x, 1e-3 * curves[name].to_numpy(), style, color=colour, label=label)
    axes.plot(
        1e3 * curves["load_displacement"].to_numpy(),
        1e-3 * curves["load"].to_numpy(),
        "s",
        color="black",
        fillstyle="none",
        label="measured law, Eq. (26)",
    )
    if measured is not None:
        axes.plot(
            1e3 * measured.displacement, 1e-3 * measured.force, "k.", markersize=4, label="measured"
        )
    axes.set_xlabel("sleeper displacement [mm]")
    axes.set_ylabel("load on a rail seat [kN]")
    tidy(axes)
    axes.set_xlim(left=0.0)
    axes.set_ylim(bottom=0.0)
    return figure
