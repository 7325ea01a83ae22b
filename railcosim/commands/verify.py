"""`railcosim verify`: a passage co-simulated and solved as one system of equations."""

import json
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer
import xarray as xr
from rich.console import Console

from orchestrator import Verdict

from ..builds import usual_build
from ..errors import RunError
from ..figures.passage import describe
from ..output import FIGURE_SUFFIXES, check_writable, write_dataset, write_figure
from ..passage import run_passage
from ..result_check import check_result
from ..scenario import Scenario
from ..scenario_file import read_scenario
from ..terminal.progress import progress_bar
from ..terminal.verdict_table import verdict_table
from ..verification import Agreement, advice, agreements, side_by_side
from .endings import exit_codes, say
from .options import FmuKind, Output, Quiet, check_output
from .stdout import stdout_for_results


class ModelName(StrEnum):
    """Coordinates of the track in the monolith."""

    FULL = "full"
    MODAL = "modal"


def verify(
    scenario: Annotated[
        Path | None, typer.Argument(metavar="SCENARIO.toml", help="The paper's case without.")
    ] = None,
    *,
    overrides: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="KEY=VALUE", help="Replace a key, as in flat.depth=1e-3."),
    ] = None,
    model: Annotated[
        ModelName, typer.Option(help="Track of the monolith: the same modes, or all nodes.")
    ] = ModelName.MODAL,
    fmus: Annotated[
        FmuKind | None,
        typer.Option(help="Which build of the FMUs runs; native, if it has been built, without."),
    ] = None,
    output: Output = None,
    plot: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Figure: .png, .pdf or .svg.")
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the differences as one JSON object.")
    ] = False,
    quiet: Quiet = False,
) -> None:
    """Compare a co-simulated passage with an independent solution; exit code 0 if they agree."""
    with exit_codes():
        case = read_scenario(scenario, overrides or ())
        case.keep.need_all("railcosim verify")
        check_output(output)
        if plot is not None:
            check_writable(plot, option="--plot", suffixes=FIGURE_SUFFIXES)
        build = usual_build("vehicle") if fmus is None else fmus.value
        with stdout_for_results():
            passage = _cosimulated(case, build, quiet=quiet)
            check_result(passage)
            monolith = _solved(case, model, passage, quiet=quiet)
        both = side_by_side(passage, monolith)
        if output is not None:
            write_dataset(both, output)
        if plot is not None:
            from ..figures.verification import draw_verification  # noqa: PLC0415 - for a plot only

            write_figure(draw_verification(both), plot)
        found = agreements(passage, monolith)
        if as_json:
            typer.echo(json.dumps(_numbers(found, passage, monolith), indent=2, allow_nan=False))
        elif not quiet:
            Console().print(_table(found, f"{describe(case)}, against the {model} monolith"))
        _check(found, passage)


def _cosimulated(case: Scenario, build: str, *, quiet: bool) -> xr.Dataset:
    if quiet:
        return run_passage(case, fmus=build)
    with progress_bar(Console(stderr=True), "co-simulation") as report:
        return run_passage(case, fmus=build, notify=say, report=report)


def _solved(case: Scenario, model: ModelName, passage: xr.Dataset, *, quiet: bool) -> xr.Dataset:
    from ..monolithic import solve  # noqa: PLC0415 - loads integrators that other commands spare

    times = passage["time"].to_numpy()
    if quiet:
        return solve(case, model=model.value, times=times)
    with progress_bar(Console(stderr=True), "monolith") as report:
        return solve(case, model=model.value, times=times, report=report)


def _numbers(
    found: list[Agreement], passage: xr.Dataset, monolith: xr.Dataset
) -> dict[str, object]:
    return {
        "holds": all(item.holds for item in found),
        "model": monolith.attrs["model"],
        "agreements": [item.as_dict() for item in found],
        "wall_time": {
            "cosimulation": float(passage.attrs["wall_time"]),
            "monolith": float(monolith.attrs["wall_time"]),
        },
    }


def _table(found: list[Agreement], title: str) -> object:
    verdicts = [
        Verdict(claim=item.quantity, holds=item.holds, detail=item.describe()) for item in found
    ]
    return verdict_table(verdicts, title)


def _check(found: list[Agreement], passage: xr.Dataset) -> None:
    """Say what is outside its limit, where, and what to do about it."""
    outside = [f"{item.quantity}: {item.describe()}" for item in found if not item.holds]
    if outside:
        raise RunError(f"the solutions differ too much, {'; '.join(outside)}; {advice(passage)}")
