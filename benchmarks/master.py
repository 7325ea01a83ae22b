"""What a macro step of two trivial FMUs costs: this project's master, bare calls and other hosts.

    python benchmarks/master.py [--steps N] [--repetitions N] [--short] [--json]

Two instances of an integrator that needs far less than a microsecond are coupled in a loop. Every
repetition runs all rows one after the other; the ratio to the raw calls is taken within each, so
that it holds on other machines too. `error` compares the last outputs with their closed form.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before numpy is loaded

import json
from argparse import ArgumentParser
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

from host_tools.answer import HostError
from host_tools.python_host import NAMES, PythonHost
from overhead.coupled import Coupled, controlled, settings
from overhead.direct import raw_calls, raw_iterated_calls, wrapper_classes
from overhead.hosts import Hosted
from overhead.system import Sample, build_fmus, largest_miss
from rich.console import Console
from rich.table import Table

SLOW = 10
"""Rows with processes or Python FMUs take so many times fewer steps."""


@dataclass(kw_only=True)
class Row:
    """A row of the table.

    Attributes
    ----------
    name : str
        What was run.
    run : callable
        Runs an FMU for so many steps.
    algorithm : str or None
        Whose closed form the result must have.
    slow : bool
        Whether it takes fewer steps.
    samples : list of Sample
        What came out, one per repetition.
    remedy : str
        Why there are none.
    """

    name: str
    run: Callable[[Path, int], Sample]
    algorithm: str | None
    slow: bool = False
    samples: list[Sample] = field(default_factory=list)
    remedy: str = ""

    def measure(self, fmu: Path, steps: int) -> None:
        """Add a sample."""
        if self.remedy:
            return
        try:
            self.samples.append(self.run(fmu, steps))
        except HostError as error:
            self.remedy = str(error)

    def error(self, fmu: Path, steps: int) -> float | None:
        """Return by how much the last outputs miss the closed form, relatively."""
        if self.algorithm is None or not self.samples:
            return None
        run = self.run
        final = run.final(fmu, steps) if isinstance(run, Coupled) else self.samples[-1].final
        assert final is not None
        return largest_miss(final, self.algorithm, steps)


def make_rows(*, short: bool) -> list[Row]:
    """Return the rows of one kind of FMU, raw calls first."""
    newton = settings("newton")
    rows = [
        Row(name="raw calls, preallocated", run=raw_calls, algorithm="jacobi"),
        Row(name="raw calls, twice with save and restore", run=raw_iterated_calls, algorithm=None),
        Row(name="fmpy's wrapper classes", run=wrapper_classes, algorithm="jacobi"),
    ]
    for name, way, algorithm in (
        ("jacobi", Coupled(settings=settings("jacobi")), "jacobi"),
        ("gauss_seidel", Coupled(settings=settings("gauss_seidel")), "gauss_seidel"),
        (
            "gauss_seidel, extrapolated",
            Coupled(settings=settings("gauss_seidel", extrapolate=True)),
            None,
        ),
        ("jacobi, recorded", Coupled(settings=settings("jacobi"), recorded=True), "jacobi"),
        ("newton", Coupled(settings=newton), "newton"),
        ("newton, recorded", Coupled(settings=newton, recorded=True), "newton"),
        ("newton, error control", Coupled(settings=controlled), None),
    ):
        rows.append(Row(name=name, run=way, algorithm=algorithm))
    if short:
        return rows
    for name in ("gauss_seidel", "newton"):
        way = Coupled(settings=settings(name), isolated=True)
        rows.append(Row(name=f"{name}, isolated", run=way, algorithm=name, slow=True))
    rows += [Row(name=name, run=Hosted(PythonHost(name)), algorithm="jacobi") for name in NAMES]
    return rows


def measure(rows: list[Row], fmu: Path, *, steps: int, repetitions: int) -> list[dict[str, object]]:
    """Run all rows so often, after one run to warm up; return what is to be shown."""
    for row in rows:
        row.measure(fmu, max(2, steps // SLOW))
        row.samples.clear()
    count = {row.name: max(2, steps // SLOW) if row.slow else steps for row in rows}
    for _ in range(repetitions):
        for row in rows:
            row.measure(fmu, count[row.name])
    raw = rows[0].samples
    results: list[dict[str, object]] = []
    for row in rows:
        pairs = zip(row.samples, raw, strict=not row.remedy)
        ratios = [sample.microseconds / least.microseconds for sample, least in pairs]
        done = bool(row.samples) and not row.remedy
        results.append(
            {
                "name": f"{row.name} {row.run.host.version}"
                if done and isinstance(row.run, Hosted)
                else row.name,
                "microseconds": median(s.microseconds for s in row.samples) if done else None,
                "ratio": median(ratios) if done else None,
                "iterations": row.samples[-1].iterations if done else None,
                "error": row.error(fmu, count[row.name]) if done else None,
                "remedy": row.remedy,
            }
        )
    return results


def show(title: str, results: list[dict[str, object]]) -> None:
    """Print a table."""
    table = Table(title=title)
    table.add_column("master")
    for heading in ("us per step", "over raw calls", "steppings", "error"):
        table.add_column(heading, justify="right")
    formats = {"microseconds": ".1f", "ratio": ".2f", "iterations": ".2f", "error": ".0e"}
    for result in results:
        if result["remedy"]:
            table.add_row(str(result["name"]), str(result["remedy"]))
            continue
        cells = (
            "" if result[key] is None else format(result[key], spec)
            for key, spec in formats.items()
        )
        table.add_row(str(result["name"]), *cells)
    Console(width=110).print(table)


def main() -> None:
    """Print the tables."""
    parser = ArgumentParser(description="What a macro step of two trivial FMUs costs.")
    parser.add_argument("--steps", type=int, default=20000, help="macro steps of a run")
    parser.add_argument("--repetitions", type=int, default=7, help="runs of every row")
    parser.add_argument("--short", action="store_true", help="one process, compiled FMUs only")
    parser.add_argument("--json", action="store_true", help="print JSON instead of tables")
    options = parser.parse_args()
    everything = {}
    with TemporaryDirectory() as folder:
        for kind, fmu in build_fmus(Path(folder)).items():
            if options.short and kind != "compiled":
                continue
            steps = options.steps if kind == "compiled" else max(2, options.steps // SLOW)
            everything[kind] = measure(
                make_rows(short=options.short), fmu, steps=steps, repetitions=options.repetitions
            )
            if not options.json:
                show(f"Macro step of two trivial FMUs, {kind}", everything[kind])
    if options.json:
        print(json.dumps(everything))


if __name__ == "__main__":
    main()
