"""What came of checking an FMU as a table for the terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.table import Table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestrator import Verdict

WORDS = {True: "holds", False: "FAILS", None: "-"}


def verdict_table(verdicts: Sequence[Verdict], title: str) -> Table:
    """Lay the verdicts out.

    Parameters
    ----------
    verdicts : sequence of Verdict
        One per claim.
    title : str
        Which FMU it is.

    Returns
    -------
    rich.table.Table
        Three columns: claim, verdict, detail.
    """
    table = Table(title=title)
    for heading in ("claim", "verdict", "detail"):
        table.add_column(heading, overflow="fold")
    for verdict in verdicts:
        table.add_row(verdict.claim, WORDS[verdict.holds], verdict.detail)
    return table
