"""What all figures have in common."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.axes import Axes

BLUE, QUIET = "#0072B2", "#767676"
"""What a figure is about, of Okabe & Ito's colours that colour-blind readers tell apart; a grey."""

OTHERS = ("#D55E00", "#009E73", "#CC79A7", "#E69F00")
"""Their colours for what stands beside it, in turn."""


def tidy(axes: Axes, *, legend: bool = True) -> None:
    """Leave grid lines, two spines and, if wanted, a legend above that hides nothing."""
    axes.grid(color="0.9", linewidth=0.6)
    axes.spines[["top", "right"]].set_visible(False)
    axes.margins(x=0.0)
    if legend:
        axes.legend(
            frameon=False, fontsize="small", loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=4
        )
