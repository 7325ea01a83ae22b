"""The picture of a verification: both contact forces and their difference."""

from __future__ import annotations

from itertools import cycle
from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from ..scenario_file import from_toml
from ..verification import FORCE_LIMIT
from .passage import describe
from .style import BLUE, OTHERS, QUIET, tidy

if TYPE_CHECKING:
    import xarray as xr


def draw_verification(both: xr.Dataset) -> Figure:
    """Draw the contact forces of both solutions above their difference.

    Parameters
    ----------
    both : xarray.Dataset
        From `verification.side_by_side`.

    Returns
    -------
    matplotlib.figure.Figure
        Two panels over the distance of the flat's wheel from the flat's centre.
    """
    figure = Figure(figsize=(8.0, 7.0), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True)
    colours, x = cycle((BLUE, *OTHERS)), both["distance"]
    for wheel in both["wheel"].to_numpy():
        own, colour = both.sel(wheel=wheel), next(colours)
        name = f"wheel {wheel}"
        above.plot(x, 1e-3 * own["contact_force_monolith"], color=colour, label=name)
        above.plot(
            x, 1e-3 * own["contact_force_cosimulation"], color="black", linestyle=":", linewidth=1.0
        )
        below.plot(x, 100.0 * own["difference"], color=colour, label=name)
    above.plot([], [], color="black", linestyle=":", label="the same co-simulated")
    for side in (-1.0, 1.0):
        below.axhline(100.0 * side * FORCE_LIMIT, color=QUIET, linestyle="--", linewidth=1.0)
    above.set_ylabel("contact force [kN]")
    below.set_ylabel("difference [% of static load]")
    below.set_xlabel("distance of the flat's wheel from the flat's centre [m]")
    for axes in (above, below):
        tidy(axes)
    scenario = from_toml(both.attrs["scenario"])
    figure.suptitle(f"{describe(scenario)}\nco-simulation and {both.attrs['model']} monolith")
    return figure
