"""The live display of a run on the terminal."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

from rich.progress import BarColumn, TextColumn, TimeRemainingColumn
from rich.progress import Progress as Bars

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from rich.console import Console

    from ..watched_control import Progress

INTERVAL = 0.1
"""Time between two updates [s]; the time left is estimated from the last thousand of them."""


@contextmanager
def progress_bar(console: Console, label: str = "passage") -> Iterator[Callable[[Progress], None]]:
    """Show a bar with simulated time, step, rejections so far and time left.

    Parameters
    ----------
    console : rich.console.Console
        Where; nothing is shown unless it is a terminal.
    label : str
        What runs.

    Yields
    ------
    callable
        Takes the progress after every decision of the master.
    """
    bars = Bars(
        TextColumn(label),
        BarColumn(),
        TextColumn(
            "t {task.fields[time]:.4f} of {task.total:.4f} s   "
            "step {task.fields[step]:.1f} us   {task.fields[rejected]} rejected"
        ),
        TimeRemainingColumn(),
        console=console,
        transient=True,
        disable=not console.is_terminal,
    )
    with bars:
        task = bars.add_task(label, total=None, visible=False, time=0.0, step=0.0, rejected=0)

        shown = -INTERVAL

        def report(progress: Progress) -> None:
            nonlocal shown
            now = bars.get_time()
            if now - shown < INTERVAL and progress.time < progress.stop_time:
                return
            shown = now
            bars.update(
                task,
                total=progress.stop_time,
                completed=progress.time,
                visible=True,
                time=progress.time,
                step=1e6 * progress.step_size,
                rejected=progress.rejected,
            )

        yield report
