"""The page: everything about a passage in one HTML file that needs nothing else."""

from __future__ import annotations

from importlib.resources import files
from typing import TYPE_CHECKING, Any

import numpy as np
from jinja2 import Environment, FunctionLoader, StrictUndefined
from markupsafe import Markup
from plotly.offline import get_plotlyjs

from .. import __version__
from ..figures.passage import SPAN, describe, strikes_once
from ..scenario_file import from_toml
from ..summary import summarise
from ..summary_lines import WINDOW_CAPTION, effort_lines, result_lines
from .animation import animate
from .embedding import inline_data, inline_script, packed, policy
from .histories import history_plots
from .palette import DARK
from .plot import thinned
from .step_log import step_log_plots, thinned_attempts
from .words import method, provenance, sentences, warnings

if TYPE_CHECKING:
    from collections.abc import Mapping

    import xarray as xr

    from .convergence import Convergence

SCRIPTS = ("data.js", "plots.js", "scene.js", "force_chart.js", "animation.js")
"""The page's own scripts after Plotly's, in the order in which they need each other."""


def write_page(passage: xr.Dataset, convergence: Convergence | None = None) -> str:
    """Write the report of a passage.

    The same result gives the same page, byte for byte.

    Parameters
    ----------
    passage : xarray.Dataset
        Result of a passage, also read back from a file, also of a run that ended early.
    convergence : Convergence, optional
        What smaller steps change; without, the page says how to find out.

    Returns
    -------
    str
        HTML text.
    """
    scenario = from_toml(passage.attrs["scenario"])
    summary = summarise(passage)
    shown = _thinned(passage)
    histories, steps = history_plots(shown), step_log_plots(passage)
    animation = animate(passage)
    zoom = _zoom(passage) if strikes_once(scenario) else None
    theme = inline_script(_asset("theme.js"))  # before the body, so that nothing is drawn twice
    scripts = [inline_script(text) for text in (get_plotlyjs(), *map(_asset, SCRIPTS))]
    data = {
        "dark": DARK,
        "axes": {"passage": _passage_axes(shown), "attempt": _attempt_axes(passage)},
        "zoom": zoom,
        "strike": _strike(passage),
        "plots": [plot.as_data() for plot in (*histories, *steps)],
        "animation": animation,
    }
    text: str = (
        _environment()
        .get_template("page.html")
        .render(
            title=describe(scenario),
            sentences=sentences(scenario),
            method=method(passage, scenario),
            warnings=warnings(passage, scenario),
            results=result_lines(summary),
            efforts=effort_lines(summary),
            window=WINDOW_CAPTION,
            histories=histories,
            steps=steps,
            zoom=zoom,
            animation=animation,
            convergence=convergence,
            provenance=provenance(passage),
            scenario=passage.attrs["scenario"],
            version=__version__,
            shown_points=shown.sizes["time"],
            all_points=passage.sizes["time"],
            style=Markup(_asset("page.css")),  # noqa: S704 - a file of this package
            theme=theme,
            scripts=scripts,
            policy=policy([theme, *scripts]),
            data=inline_data(data),
        )
    )
    return text


def _asset(name: str) -> str:
    return files(__package__).joinpath("assets", name).read_text(encoding="utf-8")


def _environment() -> Environment:
    """Return an environment that escapes every value and refuses unknown names."""
    return Environment(
        loader=FunctionLoader(_asset),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )


def _thinned(passage: xr.Dataset) -> xr.Dataset:
    """Leave out points of a long run; the extremes of the force of the flat's wheel stay."""
    force = passage["contact_force"].sel(wheel=int(passage["flat_wheel"]))
    return passage.isel(time=thinned(force.to_numpy()))


def _passage_axes(shown: xr.Dataset) -> Mapping[str, object]:
    return {axis: packed(shown[axis]) for axis in ("distance", "time")}


def _attempt_axes(passage: xr.Dataset) -> Mapping[str, object]:
    """Return when the attempts started, and where the flat's wheel was then."""
    times = thinned_attempts(passage)["attempt_time"].to_numpy()
    distances = np.interp(times, passage["time"], passage["distance"])
    return {"distance": packed(distances), "time": packed(times)}


def _strike(passage: xr.Dataset) -> dict[str, float] | None:
    """Return where and when the flat's centre meets the rail, if the run has come so far."""
    distance, time = passage["distance"].to_numpy(), passage["time"].to_numpy()
    if distance[-1] < 0.0:
        return None
    return {"distance": 0.0, "time": float(np.interp(0.0, distance, time))}


def _zoom(passage: xr.Dataset) -> dict[str, Any]:
    """Return the part of the run around the strike, as far as the run has come."""
    distance, time = passage["distance"].to_numpy(), passage["time"].to_numpy()
    span = np.clip(SPAN, distance[0], distance[-1])
    if span[0] == span[1]:
        span = distance[[0, -1]]
    return {"distance": span.tolist(), "time": np.interp(span, distance, time).tolist()}
