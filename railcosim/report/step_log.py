"""The figures of how the master stepped: sizes, rejections, iterations, errors."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import plotly.graph_objects as go

from ..figures.style import BLUE
from ..summary import CAUSES
from .palette import CAUSE_COLOURS, CAUSE_SYMBOLS
from .plot import Plot, compact, curve, figure_of, level, thinned

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

ACCEPTED = "accepted"


def thinned_attempts(passage: xr.Dataset) -> xr.Dataset:
    """Leave out attempts where there are more than a page can show; the extreme steps stay."""
    return passage.isel(attempt=thinned(passage["attempt_step_size"].to_numpy()))


def step_log_plots(passage: xr.Dataset) -> list[Plot]:
    """Draw the step log.

    Parameters
    ----------
    passage : xarray.Dataset
        Result of a passage, with all attempts.

    Returns
    -------
    list of Plot
        Step size, rejections, iterations, and, under error control, the error.
    """
    shown = thinned_attempts(passage)
    plots = [_sizes(shown, passage), _rejections(passage), _iterations(passage)]
    if bool((passage["attempt_error_norm"] > 0.0).any()) and _accepts_by_error(passage):
        plots.append(_errors(shown))
    return plots


def _accepts_by_error(passage: xr.Dataset) -> bool:
    """Whether a step with a larger error than allowed was never accepted."""
    accepted = passage["attempt_cause"] == ACCEPTED
    return not bool((passage["attempt_error_norm"].where(accepted) > 1.0).any())


def _where(condition: NDArray[np.bool_], values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Leave holes where a condition does not hold, so that curves share an abscissa."""
    return np.where(condition, values, np.nan)


def _by_cause(shown: xr.Dataset, values: NDArray[np.float64]) -> list[go.Scatter]:
    """Mark the rejected attempts, each cause by its own marker."""
    causes = shown["attempt_cause"].to_numpy()
    return [
        go.Scatter(
            y=compact(_where(causes == cause, values)),
            name=f"rejected: {cause}",
            mode="markers",
            marker={
                "symbol": CAUSE_SYMBOLS[cause],
                "size": 6,
                "color": CAUSE_COLOURS[cause],
                "line": {"width": 1.3, "color": CAUSE_COLOURS[cause]},
            },
        )
        for cause in CAUSES
        if (causes == cause).any()
    ]


def _accepted_curve(
    shown: xr.Dataset, values: NDArray[np.float64], name: str, **style: object
) -> go.Scatter:
    accepted = shown["attempt_cause"].to_numpy() == ACCEPTED
    line = curve(_where(accepted, values), name, BLUE, **style)
    return line.update(connectgaps=True)


def _sizes(shown: xr.Dataset, passage: xr.Dataset) -> Plot:
    """Size of every step, accepted or not."""
    sizes = 1e6 * shown["attempt_step_size"].to_numpy()
    taken = 1e6 * passage["attempt_step_size"].to_numpy()
    taken = taken[passage["attempt_cause"].to_numpy() == ACCEPTED]
    curves = [
        _accepted_curve(shown, sizes, ACCEPTED, shape="hv", width=1.2),
        *_by_cause(shown, sizes),
    ]
    return Plot(
        key="step-size",
        title="Step size",
        caption=f"Attempted steps. Accepted ones lie between {taken.min():.3g} and "
        f"{taken.max():.3g} µs, half of them below {np.median(taken):.3g} µs."
        if taken.size
        else "No step was accepted.",
        figure=figure_of(curves, "step size [µs]", type="log", dtick=1),
        abscissa="attempt",
    )


def _rejections(passage: xr.Dataset) -> Plot:
    """Rejected attempts by cause."""
    causes = passage["attempt_cause"].to_numpy()
    numbers = [int((causes == cause).sum()) for cause in CAUSES]
    bars = go.Bar(
        y=numbers,
        x=list(CAUSES),
        text=[str(number) for number in numbers],
        textposition="outside",
        cliponaxis=False,
        marker={"color": [CAUSE_COLOURS[cause] for cause in CAUSES]},
        showlegend=False,
    )
    share = 100.0 * sum(numbers) / max(causes.size, 1)
    return Plot(
        key="rejections",
        title="Rejected attempts by cause",
        caption=f"{sum(numbers)} of {causes.size} attempts were rejected, {share:.1f} %: too large "
        "an error, a switch of contact inside the step, no convergence, an FMU's refusal, or "
        "invalid numbers.",
        figure=figure_of([bars], "attempts", rangemode="tozero"),
    )


def _iterations(passage: xr.Dataset) -> Plot:
    """How often the FMUs were stepped in an attempt."""
    numbers, counts = np.unique(passage["attempt_iterations"].to_numpy(), return_counts=True)
    bars = go.Bar(
        x=numbers.tolist(),
        y=counts.tolist(),
        width=0.6,
        marker={"color": BLUE},
        showlegend=False,
    )
    mean = float(passage["attempt_iterations"].mean())
    figure = figure_of([bars], "attempts", rangemode="tozero")
    figure.update_layout(xaxis={"title": {"text": "iterations in an attempt"}, "dtick": 1})
    return Plot(
        key="iterations",
        title="Coupling iterations",
        caption=f"How often an attempt stepped the FMUs: {mean:.2f} times on average, at most "
        f"{numbers.max()} times.",
        figure=figure,
    )


def _errors(shown: xr.Dataset) -> Plot:
    """Error norm of the attempts, against its limit."""
    norms = shown["attempt_error_norm"].to_numpy()
    curves = [
        _accepted_curve(shown, norms, ACCEPTED, width=1.0),
        *_by_cause(shown, norms),
    ]
    usual = np.nanquantile(norms[norms > 0.0], (0.01, 1.0))
    exponents = np.log10(usual) + np.array([-0.2, 0.2])
    figure = figure_of(
        curves, "error over tolerance", type="log", dtick=1, range=exponents.tolist()
    )
    level(figure, 1.0, CAUSE_COLOURS["error"])
    return Plot(
        key="error-norm",
        title="Error norm",
        caption="Difference of prediction and result of every attempt over the tolerance. Above 1, "
        "the dashed line, the attempt is rejected and repeated with a smaller step.",
        figure=figure,
        abscissa="attempt",
    )
