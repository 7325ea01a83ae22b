"""`railcosim run`: one passage."""

import json
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Annotated

import typer
import xarray as xr
from rich.console import Console

from ..builds import usual_build
from ..errors import RunError
from ..figures.passage import describe, draw_passage
from ..notes import notes
from ..output import replacing, write_dataset, write_figure
from ..passage import run_passage
from ..result_check import check_result
from ..scenario_file import read_scenario
from ..summary import summarise
from ..terminal.progress import progress_bar
from ..terminal.summary_table import summary_table
from .endings import exit_codes, keeping, say
from .options import (
    ContactName,
    FmuKind,
    Isolate,
    Json,
    Output,
    Overrides,
    Plot,
    Quiet,
    Replay,
    ScenarioFile,
    Timeout,
    check_output,
    check_plot,
    replay_file,
    time_limit,
)
from .stdout import stdout_for_results


def run(
    scenario: ScenarioFile = None,
    *,
    overrides: Overrides = None,
    fmus: Annotated[
        FmuKind | None,
        typer.Option(help="Which build of the FMUs runs; native, if it has been built, without."),
    ] = None,
    contact: Annotated[
        ContactName, typer.Option(help="Which FMU has the contacts.")
    ] = ContactName.VEHICLE,
    isolate: Isolate = False,
    timeout: Timeout = None,
    output: Output = None,
    replay: Replay = None,
    plot: Plot = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Co-simulate one passage of a vehicle over a track."""
    with exit_codes():
        case = read_scenario(scenario, overrides or ())
        check_output(output)
        check_plot(plot)
        limit = time_limit(timeout, isolate=isolate)
        for note in notes(case, contact.value):
            say(f"note: {note}")
        if plot is not None:
            case.keep.need_all("--plot")
        run_case = partial(
            run_passage,
            case,
            fmus=usual_build(contact.value) if fmus is None else fmus.value,
            contact=contact.value,
            timeout=limit,
            replay=replay_file(replay, output),
        )
        if case.keep.is_all or output is None or output.suffix.lower() != ".nc":
            with keeping(output):
                passage = _followed(run_case, quiet=quiet)
            if output is not None:
                write_dataset(passage, output)
        else:
            passage = _written_on_the_way(run_case, output, quiet=quiet)
        if plot is not None:
            write_figure(draw_passage(passage), plot)
        summary = summarise(passage)
        if as_json:
            typer.echo(json.dumps(summary.as_dict(), indent=2, allow_nan=False))
        elif not quiet:
            Console().print(summary_table(summary, describe(case)))
        check_result(passage)


def _followed(run_case: Callable[..., xr.Dataset], *, quiet: bool) -> xr.Dataset:
    """Run with a progress bar on stderr, or without a word."""
    with stdout_for_results():
        if quiet:
            return run_case()
        with progress_bar(Console(stderr=True)) as report:
            return run_case(notify=say, report=report)


def _written_on_the_way(
    run_case: Callable[..., xr.Dataset], output: Path, *, quiet: bool
) -> xr.Dataset:
    """Run, histories going to the file; it appears at the end, also where there is a part only."""
    failure: RunError | None = None
    with replacing(output) as temporary:
        try:
            passage = _followed(partial(run_case, histories=temporary), quiet=quiet)
        except RunError as error:
            if error.result is None:
                raise
            failure = error
    if failure is not None:
        raise failure
    return passage
