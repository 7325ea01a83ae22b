"""The live display of a sweep on the terminal."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from rich.console import Console

    from .running import SweepProgress


@contextmanager
def sweep_bar(console: Console) -> Iterator[Callable[[SweepProgress], None]]:
    """Show a bar with the cases that have ended and failed, the time elapsed and the time left.

    Parameters
    ----------
    console : rich.console.Console
        Where; nothing is shown unless it is a terminal.

    Yields
    ------
    callable
        Takes the progress at the start and after every case.
    """
    bars = Progress(
        TextColumn("sweep"),
        BarColumn(),
        TextColumn(
            "{task.completed:.0f} of {task.total:.0f} cases   {task.fields[stored]} were stored   "
            "{task.fields[failed]} failed"
        ),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(),
        console=console,
        transient=True,
        disable=not console.is_terminal,
    )
    with bars:
        task = bars.add_task("sweep", total=None, visible=False, stored=0, failed=0)

        def report(progress: SweepProgress) -> None:
            bars.update(
                task,
                total=progress.total - progress.stored,  # the time left follows from those run now
                completed=progress.ended,
                visible=True,
                stored=progress.stored,
                failed=progress.failed,
            )

        yield report
