"""Figures of what differs, in files."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from ..output import write_figure

if TYPE_CHECKING:
    from pathlib import Path

    from .comparison import Comparison, SignalComparison
    from .recording import Recording

LONGEST_NAME = 80
"""Characters of a signal's name in that of a file."""


def write_overlays(
    result: Recording, baseline: Recording, comparison: Comparison, place: Path
) -> list[Path]:
    """Draw the signals that differ over their baselines.

    Parameters
    ----------
    result, baseline : Recording
        What was compared.
    comparison : Comparison
        What came of it.
    place : Path
        One file for the first of them, or a folder that exists, for one file a signal.

    Returns
    -------
    list of Path
        Files written; none if no signal differs.

    Raises
    ------
    RunError
        Where a figure cannot be written.
    """
    from ..figures.comparison import draw_comparison  # noqa: PLC0415 - a second, if it is drawn

    differing = comparison.differing
    parts: dict[Path, tuple[SignalComparison, ...]]
    if place.is_dir():
        parts = {
            place / f"{k:03d}-{_file_name(signal.name)}.png": (signal,)
            for k, signal in enumerate(differing, start=1)
        }
    else:
        parts = {place: differing} if differing else {}
    for path, signals in parts.items():
        write_figure(draw_comparison(result, baseline, comparison, signals), path)
    return list(parts)


def _file_name(signal: str) -> str:
    """Turn the name of a signal into one of a file."""
    return re.sub(r"[^\w.-]+", "_", signal).strip("_")[:LONGEST_NAME]
