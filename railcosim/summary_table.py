"""The numbers of a passage as a table for the terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.table import Table

from .summary import WINDOW

if TYPE_CHECKING:
    from .summary import Summary


WINDOW_CAPTION = (
    f"Forces and moments: the flat's wheel, {-WINDOW[0]:g} m before to {WINDOW[1]:g} m after the "
    "flat's centre."
)


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
    for what, value, factor, unit in (
        ("largest contact force", summary.peak_contact_force, 1e-3, "kN"),
        ("  from the flat's centre", summary.peak_contact_force_position, 1e3, "mm"),
        ("smallest contact force", summary.min_contact_force, 1e-3, "kN"),
        ("time without contact", summary.loss_of_contact_time, 1e3, "ms"),
        ("largest sleeper displacement", summary.max_sleeper_displacement, 1e3, "mm"),
        (
            "largest bending moment in the struck bay",
            summary.peak_bending_moment_midspan,
            1e-3,
            "kN m",
        ),
        (
            "largest bending moment under the wheel",
            summary.peak_bending_moment_under_wheel,
            1e-3,
            "kN m",
        ),
    ):
        table.add_row(what, "not reached" if value is None else f"{factor * value:.3f}", unit)
    rejected = {cause: n for cause, n in summary.steps.rejected.items() if n}
    causes = ", ".join(f"{n} {cause}" for cause, n in rejected.items())
    table.add_section()
    table.add_row("accepted steps", str(summary.steps.accepted), "")
    table.add_row("rejected attempts", str(sum(rejected.values())), causes)
    table.add_row("coupling iterations", str(summary.steps.iterations), "")
    table.add_row("simulated time", f"{summary.simulated_time:.4f}", "s")
    table.add_row("wall time", f"{summary.wall_time:.2f}", "s")
    return table
