"""Cost and accuracy of the wheel-flat passage: both kinds of FMUs, several settings of the master.

    python benchmarks/passage.py

The last two rows are the same passage as one system of equations, without FMUs or a master; `steps
of each FMU` are evaluations of its derivative there.

Every row is the paper's case (40 km/h, haversine flat, state-dependent track). The peak error is
against Newton coupling with fixed steps of 20 us; wall times compare on one machine only.
"""

from __future__ import annotations

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before numpy is loaded

from rich.console import Console
from rich.table import Table

from railcosim.monolithic import solve
from railcosim.monolithic.solution import Model
from railcosim.passage import run_passage
from railcosim.scenario_file import read_scenario
from railcosim.signals import ContactSide
from railcosim.summary import Summary, summarise

CASES = {
    "newton, tolerance 1e-2": ("master.tolerance=1e-2",),
    "newton, tolerance 2e-3 (default)": (),
    "newton, tolerance 5e-4": ("master.tolerance=5e-4",),
    "newton, 200 us": ("master.step=2e-4",),
    "newton, 100 us": ("master.step=1e-4",),
    "newton, 50 us": ("master.step=5e-5",),
    "newton, 20 us (reference)": ("master.step=2e-5",),
    "gauss_seidel, 25 us": ("master.step=2.5e-5", "master.algorithm=gauss_seidel"),
}
ON_TRACK = {
    "contact on the track, 200 us": ("master.step=2e-4",),
    "contact on the track, 100 us (default)": (),
    "contact on the track, 50 us": ("master.step=5e-5",),
}


MONOLITHS: dict[str, Model] = {
    "as one system, modes with residual": "modal",
    "as one system, all nodes": "full",
}


NATIVE_ONLY = ("newton, 50 us", "newton, 20 us (reference)", "contact on the track, 50 us")
"""Rows that take the Python FMUs long and say nothing new."""


def run(settings: tuple[str, ...], contact: ContactSide, fmus: str) -> Summary:
    """One passage."""
    return summarise(run_passage(read_scenario(None, settings), contact=contact, fmus=fmus))


def measure(fmus: str) -> dict[str, Summary]:
    """All rows of one kind of FMUs; a first passage that is not counted builds and loads them."""
    cases: dict[str, tuple[tuple[str, ...], ContactSide]] = {
        **{name: (settings, "vehicle") for name, settings in CASES.items()},
        **{name: (settings, "track") for name, settings in ON_TRACK.items()},
    }
    if fmus == "python":
        cases = {name: case for name, case in cases.items() if name not in NATIVE_ONLY}
    for contact in ("vehicle", "track"):
        run(("run.approach=0.1", "run.departure=0.1"), contact, fmus)
    return {name: run(settings, contact, fmus) for name, (settings, contact) in cases.items()}


def main() -> None:
    """Print the table."""
    table = Table(title="Wheel-flat passage")
    for heading in ("FMUs", "master"):
        table.add_column(heading)
    for heading in ("wall s / simulated s", "accepted", "rejected", "steps of each FMU", "peak kN",
                    "peak error %"):  # fmt: skip
        table.add_column(heading, justify="right")
    measured = {kind: measure(kind) for kind in ("native", "python")}
    measured["none"] = {
        name: summarise(solve(read_scenario(), model=model)) for name, model in MONOLITHS.items()
    }
    exact = measured["native"]["newton, 20 us (reference)"].peak_contact_force
    for kind, summaries in measured.items():
        for name, summary in summaries.items():
            peak = summary.peak_contact_force
            assert peak is not None
            assert exact is not None
            table.add_row(
                kind,
                name,
                f"{summary.wall_time / summary.simulated_time:.2f}",
                f"{summary.steps.accepted}",
                f"{sum(summary.steps.rejected.values())}",
                f"{summary.steps.iterations}",
                f"{peak / 1e3:.2f}",
                f"{100.0 * (peak / exact - 1.0):+.3f}",
            )
    Console(width=140).print(table)


if __name__ == "__main__":
    main()
