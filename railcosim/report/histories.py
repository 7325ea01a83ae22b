"""The figures of what happened: forces, displacements, moments and gaps over the way."""

from __future__ import annotations

from itertools import cycle
from typing import TYPE_CHECKING

import numpy as np

from ..contact_loss import contact_losses
from ..figures.passage import wheel_colours
from ..figures.style import BLUE, OTHERS, QUIET
from .palette import INK
from .plot import Plot, curve, figure_of, level

if TYPE_CHECKING:
    import plotly.graph_objects as go
    import xarray as xr

AROUND = 4
"""Sleepers that are drawn one by one: the nearest to the flat."""


def history_plots(passage: xr.Dataset) -> list[Plot]:
    """Draw the histories of a passage.

    Parameters
    ----------
    passage : xarray.Dataset
        Result of a passage, thinned as the page's abscissa is.

    Returns
    -------
    list of Plot
        Seven figures over one abscissa.
    """
    return [
        _forces(passage),
        _displacements(passage),
        _moments(passage),
        _gaps(passage),
        *(
            _at_sleepers(passage, name, title, unit, factor)
            for name, title, unit, factor in (
                ("sleeper_displacement", "Sleeper displacements", "mm", 1e3),
                ("pad_force", "Rail pad forces", "kN", 1e-3),
                ("ballast_force", "Ballast forces", "kN", 1e-3),
            )
        ),
    ]


def _per_wheel(
    passage: xr.Dataset, name: str, factor: float, label: str, **style: object
) -> list[go.Scatter]:
    """Draw a quantity of every wheel in the wheel's colour; dashes tell repeated colours apart."""
    colours = wheel_colours(passage)
    dashes = ("solid", "dash", "dot", "dashdot")
    return [
        curve(
            factor * passage[name].sel(wheel=wheel),
            label.format(wheel),
            colour,
            **{"dash": dashes[k // (1 + len(OTHERS)) % len(dashes)], **style},
        )
        for k, (wheel, colour) in enumerate(colours.items())
    ]


def _forces(passage: xr.Dataset) -> Plot:
    """Contact forces, the static load, and where the flat's wheel is off the rail."""
    wheel = int(passage["flat_wheel"])
    gap = passage["gap"].sel(wheel=wheel).to_numpy()
    bands = {axis: contact_losses(passage[axis].to_numpy(), gap) for axis in ("distance", "time")}
    static = 1e-3 * float(passage["static_wheel_load"])
    figure = figure_of(
        [
            curve(np.full(gap.shape, static), "static load", QUIET, dash="dash", width=1.2),
            *_per_wheel(passage, "contact_force", 1e-3, "wheel {}"),
        ],
        "contact force [kN]",
        rangemode="tozero",
    )
    force = 1e-3 * passage["contact_force"].sel(wheel=wheel)
    lost = len(bands["time"])
    caption = (
        f"Compression positive. The force of wheel {wheel} lies between {float(force.min()):.1f} "
        f"and {float(force.max()):.1f} kN on a static load of {static:.1f} kN; "
    ) + (
        f"shaded: wheel {wheel} is off the rail, {lost} times."
        if lost > 1
        else f"shaded: wheel {wheel} is off the rail."
        if lost
        else f"wheel {wheel} never leaves the rail."
    )
    return Plot(
        key="contact-force",
        title="Contact forces",
        caption=caption,
        figure=figure,
        abscissa="passage",
        bands=bands,
    )


def _displacements(passage: xr.Dataset) -> Plot:
    """Rail under the wheels, the wheels, and the sleeper that moves most."""
    largest = 1e3 * passage["sleeper_displacement"].max("sleeper")
    curves = [
        *_per_wheel(passage, "rail_displacement", 1e3, "rail under wheel {}"),
        *_per_wheel(passage, "wheel_displacement", 1e3, "wheel {}", dash="dot", width=1.3),
        curve(largest, "sleeper that moves most", INK, width=1.3),
    ]
    rail = float(1e3 * passage["rail_displacement"].max())
    return Plot(
        key="displacement",
        title="Displacements of rail and wheels",
        caption=f"Downwards, as they are. The rail under a wheel goes down to {rail:.3f} mm, the "
        f"sleeper that moves most to {float(largest.max()):.3f} mm.",
        figure=figure_of(curves, "displacement [mm]", autorange="reversed"),
        abscissa="passage",
    )


def _moments(passage: xr.Dataset) -> Plot:
    """Under the flat's wheel, and at the gauges."""
    wheel = int(passage["flat_wheel"])
    under = 1e-3 * passage["bending_moment_under_wheel"].sel(wheel=wheel)
    colours = (INK, *OTHERS)
    places = (
        f"gauge at {position:g} m" for position in passage["gauge_position"].to_numpy().tolist()
    )
    gauges = [
        curve(1e-3 * passage["bending_moment"].isel(gauge=k), place, colour, width=1.3)
        for k, (place, colour) in enumerate(zip(places, cycle(colours), strict=False))
    ]
    return Plot(
        key="bending-moment",
        title="Bending moments of the rail",
        caption="Sagging positive: tension in the rail foot. The gauges are in the middle of the "
        "struck bay and above the sleepers before and after it. Largest under "
        f"wheel {wheel}: {float(under.max()):.1f} kN m.",
        figure=figure_of([curve(under, f"under wheel {wheel}", BLUE), *gauges], "moment [kN m]"),
        abscissa="passage",
    )


def _gaps(passage: xr.Dataset) -> Plot:
    """Gap between wheel and rail, or compression below zero."""
    figure = figure_of(_per_wheel(passage, "gap", 1e3, "wheel {}"), "gap [mm]")
    level(figure, 0.0)
    largest = float(1e3 * passage["gap"].max())
    state = (
        f"The widest gap is {largest:.3f} mm."
        if largest > 0.0
        else "No wheel ever leaves the rail."
    )
    return Plot(
        key="gap",
        title="Gaps between wheels and rail",
        caption=f"Above zero the wheel is off the rail, below zero the contact is compressed. "
        f"{state}",
        figure=figure,
        abscissa="passage",
    )


def _at_sleepers(passage: xr.Dataset, name: str, title: str, unit: str, factor: float) -> Plot:
    """Draw a quantity at the sleepers nearest to the flat, in their order along the rail."""
    away = abs(passage["sleeper_position"] - passage["flat_position"]).to_numpy()
    nearest = sorted(away.argsort()[:AROUND].tolist())
    values = factor * passage[name]
    curves = [
        curve(values.isel(sleeper=k), f"sleeper {k + 1}", colour)
        for k, colour in zip(nearest, (OTHERS[1], BLUE, OTHERS[0], OTHERS[2]), strict=False)
    ]
    where = int(values.max("time").to_numpy().argmax())
    down = unit == "mm"
    return Plot(
        key=name.replace("_", "-"),
        title=title,
        caption=f"{'Downwards' if down else 'Compression positive'}. The {len(nearest)} sleepers "
        f"nearest to the flat; sleeper {where + 1} of {values.sizes['sleeper']} has the largest "
        f"value, {float(values.max()):.3g} {unit}.",
        figure=figure_of(
            curves,
            f"{'displacement' if down else 'force'} [{unit}]",
            **({"autorange": "reversed"} if down else {}),
        ),
        abscissa="passage",
    )
