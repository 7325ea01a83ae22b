"""What came of repeating a failed run, for the terminal and as JSON."""

from __future__ import annotations

from dataclasses import asdict
from math import isfinite
from typing import TYPE_CHECKING, Any

from rich.table import Table

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestrator.replay import Repetition, ReplayCase


def repetition_table(case: ReplayCase, repetition: Repetition) -> Table:
    """Lay out what every FMU was told and answered in the last attempt.

    Returns
    -------
    rich.table.Table
        A row per step of an FMU, in order.
    """
    way = "all of it" if repetition.from_start else "its last attempt, from the saved states"
    table = Table(title=f"{case.name}: {way}")
    for heading in ("FMU", "iteration", "time [s]", "step [s]", "inputs", "outputs", "status"):
        table.add_column(heading, overflow="fold")
    for row in repetition.rows:
        table.add_row(
            row.participant,
            str(row.iteration),
            f"{row.time:.9g}",
            f"{row.step_size:.6g}",
            _list(row.inputs),
            _list(row.outputs),
            row.status,
        )
    return table


def repetition_numbers(case: ReplayCase, repetition: Repetition) -> dict[str, Any]:
    """Return what ``--json`` prints; values that are not finite are texts."""
    rows = [asdict(row) for row in repetition.rows]
    for row in rows:
        for key in ("inputs", "outputs"):
            row[key] = {
                name: value if isfinite(value) else str(value) for name, value in row[key].items()
            }
    return {
        "error": case.error,
        "repeated": repetition.message,
        "reproduced": repetition.reproduced,
        "from_start": repetition.from_start,
        "steps": rows,
    }


def _list(values: Mapping[str, float]) -> str:
    return "\n".join(f"{name} = {value:.9g}" for name, value in values.items())
