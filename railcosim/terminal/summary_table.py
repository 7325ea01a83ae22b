"""The numbers of a passage as a table for the terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.table import Table

from ..summary_lines import WINDOW_CAPTION, effort_lines, result_lines, whole_run_lines

if TYPE_CHECKING:
    from ..summary import Summary


def summary_table(summary: Summary, title: str) -> Table:
    """Lay the numbers out with the units an engineer expects.

    Parameters
    ----------
    summary : Summary
        Numbers in SI units.
    title : str
        Which passage it was.

    Returns
    -------
    rich.table.Table
        Three columns: what, value, unit.
    """
    table = Table(title=title, caption=WINDOW_CAPTION, show_header=False)
    table.add_column("what")
    table.add_column("value", justify="right")
    table.add_column("unit")
    for lines in (result_lines, whole_run_lines, effort_lines):
        for line in lines(summary):
            table.add_row(*line)
        table.add_section()
    return table
