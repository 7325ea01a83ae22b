"""`railcosim sweep`: a study of many passages."""

import json
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
import xarray as xr
from rich.console import Console
from rich.table import Table

from ..errors import RunError
from ..output import check_writable, write_dataset
from ..sweep import SweepProgress, read_study, run_study
from ..sweep.progress import sweep_bar
from .endings import exit_codes, say
from .options import Quiet
from .stdout import stdout_for_results

RESULT_SUFFIXES = (".nc",)
"""Kinds of result file: a table has no room for dimensions."""


def sweep(
    study: Annotated[Path, typer.Argument(metavar="STUDY.toml", help="What is swept.")],
    *,
    store: Annotated[
        Path | None,
        typer.Option(metavar="FOLDER", help="Keeps every case; STUDY.store without."),
    ] = None,
    output: Annotated[
        Path | None, typer.Option(metavar="FILE.nc", help="Result; STUDY.nc without.")
    ] = None,
    workers: Annotated[
        int | None,
        typer.Option(metavar="N", help="Processes on this machine; one for every core without."),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(metavar="tcp://HOST:PORT", help="Run on the workers of this dask scheduler."),
    ] = None,
    retry_failed: Annotated[
        bool, typer.Option("--retry-failed", help="Run cases again that have failed before.")
    ] = False,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print what was done as one JSON object.")
    ] = False,
    quiet: Quiet = False,
) -> None:
    """Run a study of many passages; started again, it goes on where it was ended."""
    with exit_codes():
        described = read_study(study)
        output = output or study.with_suffix(".nc")
        check_writable(output, option="--output", suffixes=RESULT_SUFFIXES)
        console = Console(stderr=True, quiet=quiet)
        last = SweepProgress(0, 0, 0, 0)
        with stdout_for_results(), sweep_bar(console) as show:

            def report(progress: SweepProgress) -> None:
                nonlocal last
                last = progress
                show(progress)

            try:
                result = run_study(
                    described,
                    store=store or study.with_suffix(".store"),
                    workers=workers,
                    scheduler=scheduler,
                    retry_failed=retry_failed,
                    notify=None if quiet else say,
                    report=report,
                )
            except KeyboardInterrupt as error:
                raise RunError(
                    f"interrupted with {last.stored + last.ended} of {last.total} cases stored; "
                    "the same command goes on with the others"
                ) from error
        write_dataset(result, output)
        failures = _failures(result)
        if as_json:
            typer.echo(json.dumps(_summary(last, failures, output), indent=2))
        elif not quiet:
            Console().print(_table(last, result, output))
        if failures:
            raise RunError(_sentence(failures, result.attrs["cases"]))


def _failures(result: xr.Dataset) -> list[dict[str, Any]]:
    """List the swept keys and the reason of every case that failed."""
    failure = result["failure"]
    places = np.argwhere(failure.to_numpy() != "")
    found = []
    for place in places:
        one = failure[tuple(place)]
        keys = {str(name): axis.item() for name, axis in one.coords.items() if axis.ndim == 0}
        found.append({"case": keys, "reason": str(one.item())})
    return found


def _summary(
    progress: SweepProgress, failures: list[dict[str, Any]], output: Path
) -> dict[str, Any]:
    return {
        "cases": progress.total,
        "stored_before": progress.stored,
        "run": progress.ended,
        "failed": failures,
        "output": str(output),
    }


def _table(progress: SweepProgress, result: xr.Dataset, output: Path) -> Table:
    """Lay out what was done."""
    table = Table(title=f"Study of {result.attrs['cases']} cases", show_header=False)
    table.add_column("what")
    table.add_column("value", justify="right")
    for what, value in (
        ("stored before", progress.stored),
        ("run now", progress.ended),
        ("failed", result.attrs["failed_cases"]),
        ("with warnings", int((result["warnings"] != "").sum())),
        ("result", output),
    ):
        table.add_row(what, str(value))
    return table


def _sentence(failures: list[dict[str, Any]], cases: int) -> str:
    first = failures[0]
    keys = ", ".join(f"{key} = {value}" for key, value in first["case"].items())
    others = f"{len(failures)} of {cases} cases failed, the first ({keys})"
    reason = first["reason"].rstrip(".")
    return (
        f"{others} because {reason}; the result has all others and every reason, and "
        "--retry-failed runs them again"
    )
