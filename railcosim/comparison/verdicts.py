"""A comparison as a table for the terminal."""

from __future__ import annotations

import io
import math
from typing import TYPE_CHECKING

from rich.box import SIMPLE_HEAD
from rich.console import Console, Group
from rich.markup import escape
from rich.table import Table

if TYPE_CHECKING:
    from rich.console import RenderableType

    from .comparison import Comparison, SignalComparison

SHOWN = 20
"""Rows of the table: all that differ, and the nearest to their tolerance up to so many."""

HEADINGS = ("NRMS\n[%]", "largest\n[%]", "at\n[s]", "of\ntube", "peak\n[%]", "shift\n[s]")
"""Headings of the numbers, narrow enough to leave names room on a terminal of 80 characters."""

WIDTH = 140
"""Characters in a line of a text that is no terminal's."""


def comparison_table(comparison: Comparison) -> RenderableType:
    """Lay a comparison out: its signals, what differs as a whole, and what is worth knowing."""
    return Group(_signal_table(comparison), *(escape(line) for line in _lines(comparison)))


def comparison_text(comparison: Comparison) -> str:
    """Return the same as plain text."""
    text = io.StringIO()
    Console(file=text, width=WIDTH, no_color=True).print(comparison_table(comparison))
    return text.getvalue()


def _signal_table(comparison: Comparison) -> Table:
    ordered = sorted(comparison.signals, key=_nearness, reverse=True)
    shown = ordered[: max(SHOWN, len(comparison.differing))]
    table = Table(
        title=escape(f"{comparison.result} beside {comparison.baseline}"),
        caption=_caption(comparison, len(shown)),
        box=SIMPLE_HEAD,
        padding=(0, 1, 0, 0),
    )
    table.add_column("signal", overflow="fold")
    table.add_column("verdict", no_wrap=True)
    for heading in HEADINGS:
        table.add_column(escape(heading), justify="right", no_wrap=True)
    for signal in shown:
        table.add_row(*(escape(cell) for cell in _row(signal)))
    for name in comparison.missing:
        table.add_row(escape(name), "MISSING", *[""] * len(HEADINGS))
    return table


def _row(signal: SignalComparison) -> list[str]:
    verdict = "agrees" if signal.agrees else "DIFFERS"
    measures = signal.measures
    if measures is None:
        return [signal.name, verdict, *[""] * len(HEADINGS)]
    return [
        signal.name,
        verdict,
        f"{100.0 * measures.nrms:.2g}",
        f"{100.0 * measures.relative_difference:.2g}",
        f"{measures.difference_time:.5g}",
        f"{_nearness(signal)[1]:.2g}",
        f"{100.0 * measures.peak_difference:.2g}",
        f"{measures.shift:.2g}",
    ]


def _nearness(signal: SignalComparison) -> tuple[bool, float]:
    """Order signals by how much of the tube they need, those that differ first."""
    if signal.measures is None:
        return True, math.inf
    need = signal.measures.excess
    used = need / signal.allowed if signal.allowed > 0.0 else (math.inf if need > 0.0 else 0.0)
    return not signal.agrees, used


def _caption(comparison: Comparison, shown: int) -> str:
    more = len(comparison.signals) - shown
    rest = f"; {more} more agree" if more else ""
    start, stop = comparison.interval
    return (
        f"From {start:.6g} to {stop:.6g} s{rest}. Per cent of the baseline's range, of its peak; "
        "the tube may be needed up to 1."
    )


def _lines(comparison: Comparison) -> list[str]:
    """Say below the table why signals differ, and what else there is to know."""
    extra = [f"only in the result: {len(comparison.extra)} signals"] if comparison.extra else []
    facts = [
        f"for information, {fact.name}: {fact.result or '-'} (baseline: {fact.baseline or '-'})"
        for fact in comparison.facts
    ]
    differing = [f"{item.name}: {'; '.join(item.reasons)}" for item in comparison.differing]
    return [*differing, *comparison.problems, *extra, *comparison.notes, *facts]
