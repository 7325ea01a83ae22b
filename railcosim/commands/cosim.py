"""`railcosim cosim`: the system of FMUs of a description."""

import json
from enum import StrEnum
from functools import partial
from pathlib import Path
from typing import Annotated

import typer
import xarray as xr
from rich.console import Console

from ..cosim import run_system
from ..cosim_options import CosimOptions
from ..cosim_result import cosim_table, summarise_cosim
from ..output import write_dataset
from ..result_check import check_result
from ..terminal.progress import progress_bar
from .endings import exit_codes, keeping, say
from .options import Isolate, Output, Quiet, Replay, Timeout, check_output, replay_file, time_limit
from .stdout import stdout_for_results


class AlgorithmName(StrEnum):
    """Coupling algorithms."""

    NEWTON = "newton"
    GAUSS_SEIDEL = "gauss_seidel"
    JACOBI = "jacobi"


def cosim(
    system: Annotated[Path, typer.Argument(metavar="SYSTEM.ssp|.ssd", help="FMUs, connected.")],
    *,
    stop_time: Annotated[
        float | None, typer.Option(metavar="S", help="End of the run; the file's without.")
    ] = None,
    tolerance: Annotated[
        float | None,
        typer.Option(
            metavar="X", help="Error allowed in a step over the nominal values; the file's or 1e-4."
        ),
    ] = None,
    algorithm: Annotated[AlgorithmName | None, typer.Option(help="How values are coupled.")] = None,
    step: Annotated[
        float | None, typer.Option(metavar="S", help="Fixed step, without error control.")
    ] = None,
    min_step: Annotated[float | None, typer.Option(metavar="S", help="Smallest step.")] = None,
    max_step: Annotated[float | None, typer.Option(metavar="S", help="Largest step.")] = None,
    bond: Annotated[
        list[str] | None,
        typer.Option(
            metavar="FORCE,MOTION",
            help="Outputs that carry power: add up the energy made or lost; may be repeated.",
        ),
    ] = None,
    audit: Annotated[
        int | None,
        typer.Option(metavar="N", help="Measure the error of every N-th step by two half steps."),
    ] = None,
    event: Annotated[
        list[str] | None,
        typer.Option(
            metavar="COMPONENT.VARIABLE",
            help="Signed output whose changes of sign are landed on; may be repeated.",
        ),
    ] = None,
    isolate: Isolate = False,
    timeout: Timeout = None,
    output: Output = None,
    replay: Replay = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the numbers as one JSON object.")
    ] = False,
    quiet: Quiet = False,
) -> None:
    """Co-simulate the FMUs of a system description; options count more than the file."""
    with exit_codes():
        options = CosimOptions(
            stop_time=stop_time,
            tolerance=tolerance,
            algorithm=None if algorithm is None else algorithm.value,
            step=step,
            min_step=min_step,
            max_step=max_step,
            audit=audit,
            bonds=tuple(bond or ()),
            events=tuple(event or ()),
        )
        check_output(output)
        with keeping(output), stdout_for_results():
            result = _followed_cosim(
                system,
                options,
                time_limit(timeout, isolate=isolate),
                replay_file(replay, output),
                with_histories=output is not None,
                quiet=quiet,
            )
        if output is not None:
            write_dataset(result, output)
        if as_json:
            typer.echo(json.dumps(summarise_cosim(result), indent=2, allow_nan=False))
        elif not quiet:
            Console().print(cosim_table(result))
        check_result(result)


def _followed_cosim(
    system: Path,
    options: CosimOptions,
    timeout: float | None,
    replay: Path | None,
    *,
    with_histories: bool,
    quiet: bool,
) -> xr.Dataset:
    """Do the same for a system."""
    run = partial(
        run_system,
        system,
        options,
        timeout=timeout,
        replay=replay,
        with_histories=with_histories,
    )
    if quiet:
        return run()
    with progress_bar(Console(stderr=True), system.stem) as report:
        return run(notify=say, report=report)
