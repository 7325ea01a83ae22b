"""An interactive figure of the page: its curves, its title, and what it shows in words."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np
import plotly.graph_objects as go

from ..figures.style import QUIET

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from numpy.typing import ArrayLike, NDArray

Intervals: TypeAlias = list[tuple[float, float]]
"""Starts and ends."""

MOST_POINTS = 8_000
"""Points of a curve on the page, which keep it quick and small."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Plot:
    """A figure of the page.

    Attributes
    ----------
    key : str
        Identifier of its element on the page.
    title, caption : str
        What it shows, and what there is to be seen in words and numbers.
    figure : plotly.graph_objects.Figure
        Its curves; those over time or distance are without abscissa.
    abscissa : {"passage", "attempt"}, optional
        Whose times and distances are the abscissa; without, the figure has one of its own.
    bands : mapping of str to list of (float, float)
        What is shaded over the ``distance`` [m] and over the ``time`` [s].
    """

    key: str
    title: str
    caption: str
    figure: go.Figure
    abscissa: Literal["passage", "attempt"] | None = None
    bands: Mapping[str, Intervals] = field(default_factory=dict)

    def as_data(self) -> dict[str, Any]:
        """Return what the page's script draws; arrays are base64 of the numbers."""
        drawn = json.loads(self.figure.to_json())
        return {
            "key": self.key,
            "data": drawn["data"],
            "layout": drawn["layout"],
            "abscissa": self.abscissa,
            "bands": self.bands,
        }


def compact(values: ArrayLike) -> NDArray[np.float32]:
    """Return numbers in the precision of the page, about seven digits."""
    return np.asarray(values, dtype=np.float32)


def curve(values: ArrayLike, name: str, colour: str, **style: Any) -> go.Scatter:  # noqa: ANN401 - of plotly's lines
    """Draw a curve, over an abscissa that the page gives to it.

    Parameters
    ----------
    values : array_like, shape (n,)
        Ordinates in the unit of the axis.
    name : str
        Its entry in the legend.
    colour : str
        A colour of `palette`.
    **style
        Properties of the line: ``width``, ``dash``, ``shape``.
    """
    line = {"color": colour, "width": 1.6, **style}
    return go.Scatter(y=compact(values), name=name, mode="lines", line=line)


def figure_of(curves: Iterable[go.Scatter | go.Bar], ordinate: str, **axis: Any) -> go.Figure:  # noqa: ANN401 - of plotly's axes
    """Put curves over each other, with the title and other properties of their vertical axis."""
    figure = go.Figure(list(curves))
    figure.update_layout(template="none", yaxis={"title": {"text": ordinate}, **axis})
    return figure


def level(figure: go.Figure, value: float, colour: str = QUIET) -> None:
    """Mark a value of the vertical axis by a dashed line."""
    figure.add_hline(value, line={"color": colour, "width": 1.2, "dash": "dash"})


def thinned(values: NDArray[np.float64], most: int = MOST_POINTS) -> NDArray[np.intp]:
    """Choose points that keep the look of a long curve: extremes of equal shares, and the ends.

    Parameters
    ----------
    values : ndarray, shape (n,)
        The curve whose extremes are kept.
    most : int
        How many points are enough.

    Returns
    -------
    ndarray of int, shape (at most `most`,)
        Indices in increasing order; all of them if there are few enough.
    """
    if values.size <= most:
        return np.arange(values.size)
    edges = np.linspace(0, values.size, most // 2, dtype=int)
    shares = [(start, values[start:end]) for start, end in pairwise(edges.tolist())]
    chosen = {start + k for start, share in shares for k in (share.argmin(), share.argmax())}
    return np.array(sorted(chosen | {0, values.size - 1}))
