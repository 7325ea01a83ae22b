"""The colours of the page's figures, on white and on a dark page."""

from __future__ import annotations

from ..figures.style import BLUE, OTHERS, QUIET

INK = "#1B2126"
"""Text and what stands for the whole, on white."""

DARK = {
    BLUE: "#56B4E9",
    INK: "#E8EDF1",
    QUIET: "#8C96A0",
    OTHERS[0]: "#F08A4B",
    OTHERS[1]: "#2FC79A",
    OTHERS[2]: "#E39BC5",
    OTHERS[3]: "#F0B429",
}
"""For every colour on white the one of the same hue that stands out as much on a dark page."""

CAUSE_COLOURS = {
    "error": OTHERS[0],
    "event": OTHERS[1],
    "convergence": OTHERS[2],
    "discard": OTHERS[3],
    "invalid": INK,
}
"""Why attempts are rejected."""

CAUSE_SYMBOLS = {
    "error": "x-thin-open",
    "event": "diamond-open",
    "convergence": "triangle-up-open",
    "discard": "square-open",
    "invalid": "cross-open",
}
"""Markers that tell the causes apart without any colour."""
