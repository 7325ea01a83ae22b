"""Options that several commands share."""

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from orchestrator.isolated import DEFAULT_TIMEOUT

from ..errors import InputError
from ..output import DATA_SUFFIXES, FIGURE_SUFFIXES, REPLAY_SUFFIX, check_writable


class FmuKind(StrEnum):
    """Which build of the FMUs."""

    PYTHON = "python"
    NATIVE = "native"


class ContactName(StrEnum):
    """Which of the two FMUs has the contacts."""

    VEHICLE = "vehicle"
    TRACK = "track"


Isolate = Annotated[bool, typer.Option("--isolate", help="Run each FMU in a process of its own.")]
Timeout = Annotated[
    float | None,
    typer.Option(metavar="S", help="Longest answer of an FMU [s]; with --isolate, 60 without."),
]
ScenarioFile = Annotated[
    Path | None, typer.Argument(metavar="SCENARIO.toml", help="The paper's case without.")
]
Overrides = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="KEY=VALUE", help="Replace a key, as in flat.depth=1e-3."),
]
Json = Annotated[
    bool, typer.Option("--json", help="Print the numbers as one JSON object, SI units.")
]
Plot = Annotated[Path | None, typer.Option(metavar="FILE", help="Figure: .png, .pdf or .svg.")]
Output = Annotated[
    Path | None, typer.Option(metavar="FILE", help="Result: .nc, .csv, .parquet or .mat.")
]
Replay = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE.replay", help="Written if the run fails; without, beside the output."
    ),
]
Quiet = Annotated[bool, typer.Option("--quiet", help="No progress and no table.")]


def time_limit(timeout: float | None, *, isolate: bool) -> float | None:
    """Return the time-out of isolated FMUs [s], or None where they are not isolated."""
    if timeout is None:
        return DEFAULT_TIMEOUT if isolate else None
    if not isolate:
        raise InputError(f"--timeout {timeout:g} has no effect without --isolate: give both")
    if not timeout > 0.0:
        raise InputError(f"--timeout is {timeout:g} s but must be above 0 s")
    return timeout


def replay_file(replay: Path | None, output: Path | None) -> Path | None:
    """Return where to write a replay file: as told, else beside the output."""
    if replay is None:
        return None if output is None else output.with_suffix(REPLAY_SUFFIX)
    check_writable(replay, option="--replay", suffixes=(REPLAY_SUFFIX,))
    return replay


def check_output(output: Path | None) -> None:
    """Find out before a run whether its result can be written, if it is to be."""
    if output is not None:
        check_writable(output, option="--output", suffixes=DATA_SUFFIXES)


def check_plot(plot: Path | None) -> None:
    """Find out before a run whether its figure can be written, if it is to be."""
    if plot is not None:
        check_writable(plot, option="--plot", suffixes=FIGURE_SUFFIXES)
