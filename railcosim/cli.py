"""The command line: `railcosim run`, `cosim`, `replay`, `build` and `check`."""

import json
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict
from enum import StrEnum
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import typer
import xarray as xr
from rich.console import Console
from threadpoolctl import threadpool_limits

import orchestrator
from build_fmus import folder_of
from fmu_src.native.compiler import TARGETS
from orchestrator import check_fmu
from orchestrator.isolated import DEFAULT_TIMEOUT
from orchestrator.replay import open_replay, repeat

from . import __version__
from .builds import usual_build
from .cosim import run_system
from .cosim_options import CosimOptions
from .cosim_result import cosim_table, summarise_cosim
from .errors import InputError, RunError
from .figures import describe, draw_passage
from .notes import notes
from .output import (
    DATA_SUFFIXES,
    FIGURE_SUFFIXES,
    REPLAY_SUFFIX,
    check_writable,
    write_dataset,
    write_figure,
)
from .paper_case import build_native, build_python
from .passage import run_passage
from .progress import progress_bar
from .repetition_report import repetition_numbers, repetition_table
from .scenario import Scenario
from .scenario_file import read_scenario
from .summary import summarise
from .summary_table import summary_table
from .verdict_table import verdict_table

USAGE_ERROR: Any = typer.BadParameter.__mro__[1]
"""What typer raises for a wrong command line; newer versions bring a click of their own."""

app = typer.Typer(
    name="railcosim",
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
)


ISOLATE = Annotated[bool, typer.Option("--isolate", help="Run each FMU in a process of its own.")]
TIMEOUT = Annotated[
    float | None,
    typer.Option(metavar="S", help="Longest answer of an FMU [s]; with --isolate, 60 without."),
]

REPLAY = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE.replay", help="Written if the run fails; without, beside the output."
    ),
]


class ContactName(StrEnum):
    """Which of the two FMUs has the contacts."""

    VEHICLE = "vehicle"
    TRACK = "track"


class AlgorithmName(StrEnum):
    """Coupling algorithms."""

    NEWTON = "newton"
    GAUSS_SEIDEL = "gauss_seidel"
    JACOBI = "jacobi"


class FmuKind(StrEnum):
    """Which build of the FMUs runs."""

    PYTHON = "python"
    NATIVE = "native"


def main() -> None:
    """Run the command line; the process ends with 0 done, 1 the run failed, 2 wrong input."""
    # a run ends as after Ctrl-C, with its folders removed
    signal.signal(signal.SIGTERM, lambda *_: signal.raise_signal(signal.SIGINT))
    try:
        code = app(sys.argv[1:] or ["--help"], standalone_mode=False)
    except USAGE_ERROR as error:
        _say(f"{' '.join(error.format_message().split())}; see railcosim --help")
        code = 2
    except typer.Abort:
        code = 1
    sys.exit(code)


def _show_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"railcosim {__version__}")
        raise typer.Exit


@app.callback()
def _railcosim(
    *,
    _: Annotated[
        bool,
        typer.Option(
            "--version", callback=_show_version, is_eager=True, help="Show the version and stop."
        ),
    ] = False,
) -> None:
    """Vertical train-track interaction as a co-simulation of two FMUs."""


@app.command()
def run(
    scenario: Annotated[
        Path | None, typer.Argument(metavar="SCENARIO.toml", help="The paper's case without.")
    ] = None,
    *,
    overrides: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="KEY=VALUE", help="Replace a key, as in flat.depth=1e-3."),
    ] = None,
    fmus: Annotated[
        FmuKind | None,
        typer.Option(help="Which build of the FMUs runs; native, if it has been built, without."),
    ] = None,
    contact: Annotated[
        ContactName, typer.Option(help="Which FMU has the contacts.")
    ] = ContactName.VEHICLE,
    isolate: ISOLATE = False,
    timeout: TIMEOUT = None,
    output: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Result: .nc, .csv or .parquet.")
    ] = None,
    replay: REPLAY = None,
    plot: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Figure: .png, .pdf or .svg.")
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the numbers as one JSON object, SI units.")
    ] = False,
    quiet: Annotated[bool, typer.Option("--quiet", help="No progress and no table.")] = False,
) -> None:
    """Co-simulate one passage of a vehicle over a track."""
    with _exit_codes():
        case = read_scenario(scenario, overrides or ())
        if output is not None:
            check_writable(output, option="--output", suffixes=DATA_SUFFIXES)
        if plot is not None:
            check_writable(plot, option="--plot", suffixes=FIGURE_SUFFIXES)
        limit = _time_limit(timeout, isolate=isolate)
        for note in notes(case, contact.value):
            _say(f"note: {note}")
        with _keeping(output):
            passage = _followed_run(
                case,
                usual_build(contact.value) if fmus is None else fmus.value,
                contact,
                timeout=limit,
                replay=_replay_file(replay, output),
                quiet=quiet,
            )
        if output is not None:
            write_dataset(passage, output)
        if plot is not None:
            write_figure(draw_passage(passage), plot)
        summary = summarise(passage)
        if as_json:
            typer.echo(json.dumps(summary.as_dict(), indent=2, allow_nan=False))
        elif not quiet:
            Console().print(summary_table(summary, describe(case)))
        _check_result(passage)


@app.command()
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
    isolate: ISOLATE = False,
    timeout: TIMEOUT = None,
    output: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Result: .nc, .csv or .parquet.")
    ] = None,
    replay: REPLAY = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the numbers as one JSON object.")
    ] = False,
    quiet: Annotated[bool, typer.Option("--quiet", help="No progress and no table.")] = False,
) -> None:
    """Co-simulate the FMUs of a system description; options count more than the file."""
    with _exit_codes():
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
        if output is not None:
            check_writable(output, option="--output", suffixes=DATA_SUFFIXES)
        with _keeping(output):
            result = _followed_cosim(
                system,
                options,
                _time_limit(timeout, isolate=isolate),
                _replay_file(replay, output),
                with_histories=output is not None,
                quiet=quiet,
            )
        if output is not None:
            write_dataset(result, output)
        if as_json:
            typer.echo(json.dumps(summarise_cosim(result), indent=2, allow_nan=False))
        elif not quiet:
            Console().print(cosim_table(result))
        _check_result(result)


@app.command()
def build(
    directory: Annotated[
        Path | None,
        typer.Option("--output", metavar="FOLDER", help="Where to; dist/ or dist/native/ without."),
    ] = None,
    kind: Annotated[FmuKind, typer.Option(help="Which build.")] = FmuKind.PYTHON,
    platform: Annotated[
        list[str] | None,
        typer.Option(
            metavar="|".join(TARGETS), help="Of native FMUs; may be repeated; all without."
        ),
    ] = None,
) -> None:
    """Build the FMUs of the paper's case and its systems where they are missing or stale."""
    with _exit_codes():
        folder = directory or folder_of(kind.value)
        if kind is FmuKind.NATIVE:
            written = build_native(folder, platform or tuple(TARGETS), notify=_say)
        elif platform:
            raise InputError("--platform is for --kind native: leave it out")
        else:
            written = build_python(folder, notify=_say)
        for path in written:
            typer.echo(path)


@app.command()
def replay(
    file: Annotated[Path, typer.Argument(metavar="FILE.replay", help="From a run that failed.")],
    *,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print what happened as one JSON object.")
    ] = False,
) -> None:
    """Repeat how a run failed; exit code 0 if it fails in the same way."""
    with _exit_codes(), threadpool_limits(limits=1, user_api="blas"):
        try:
            with open_replay(file) as case:
                repetition = repeat(case)
        except orchestrator.InputError as error:
            raise InputError(str(error)) from error
        if as_json:
            numbers = repetition_numbers(case, repetition)
            typer.echo(json.dumps(numbers, indent=2, allow_nan=False))
        else:
            Console().print(repetition_table(case, repetition))
            typer.echo(repetition.message or "It did not fail.")
        if not repetition.reproduced:
            raise RunError(f"it did not end in the same way; the run ended so: {case.error}")


@app.command()
def check(
    fmu: Annotated[
        Path, typer.Argument(metavar="FMU", help="An FMI 2.0 or 3.0 co-simulation FMU.")
    ],
    *,
    step: Annotated[float, typer.Option(metavar="S", help="Step to try it with [s].")] = 1e-3,
    timeout: Annotated[
        float, typer.Option(metavar="S", help="Longest answer to one call [s].")
    ] = DEFAULT_TIMEOUT,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the verdicts as one JSON object.")
    ] = False,
) -> None:
    """Try what an FMU claims, in processes that may crash; exit code 0 if all of it holds."""
    with _exit_codes():
        try:
            verdicts = check_fmu(fmu, step_size=step, timeout=timeout)
        except orchestrator.InputError as error:
            raise InputError(str(error)) from error
        if as_json:
            typer.echo(json.dumps({item.claim: asdict(item) for item in verdicts}, indent=2))
        else:
            Console().print(verdict_table(verdicts, fmu.name))
        broken = [item.claim for item in verdicts if item.holds is False]
        if broken:
            raise RunError(f"{fmu.name}: it does not hold that {' and that '.join(broken)}")


def _time_limit(timeout: float | None, *, isolate: bool) -> float | None:
    """Return the time-out of isolated FMUs [s], or None where they are not isolated."""
    if timeout is None:
        return DEFAULT_TIMEOUT if isolate else None
    if not isolate:
        raise InputError(f"--timeout {timeout:g} has no effect without --isolate: give both")
    if not timeout > 0.0:
        raise InputError(f"--timeout is {timeout:g} s but must be above 0 s")
    return timeout


def _followed_run(
    case: Scenario,
    fmus: str,
    contact: ContactName,
    *,
    timeout: float | None,
    replay: Path | None,
    quiet: bool,
) -> xr.Dataset:
    """Run with a progress bar on stderr, or without a word."""
    run_case = partial(
        run_passage,
        case,
        fmus=fmus,
        contact=contact.value,
        timeout=timeout,
        replay=replay,
    )
    if quiet:
        return run_case()
    with progress_bar(Console(stderr=True)) as report:
        return run_case(notify=_say, report=report)


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
        return run(notify=_say, report=report)


def _replay_file(replay: Path | None, output: Path | None) -> Path | None:
    """Return where to write a replay file: as told, else beside the output."""
    if replay is None:
        return None if output is None else output.with_suffix(REPLAY_SUFFIX)
    check_writable(replay, option="--replay", suffixes=(REPLAY_SUFFIX,))
    return replay


@contextmanager
def _keeping(output: Path | None) -> Iterator[None]:
    """Write what there is of a result when the run fails."""
    try:
        yield
    except RunError as error:
        if output is not None and error.result is not None:
            try:
                write_dataset(error.result, output)
            except RunError as another:
                raise RunError(f"{error}; {another}") from error
        raise


def _check_result(result: xr.Dataset) -> None:
    """Say why a run ended early or is wrong, if it did or is."""
    if not result.attrs["complete"]:
        raise RunError(
            f"the run ended at t = {result.attrs['simulated_time']:.6g} s, because "
            f"{result.attrs['stop_reason']}; the result reaches up to there"
        )
    if result.attrs["unreliable"]:
        raise RunError(f"the result is wrong: {result.attrs['unreliable'].splitlines()[0]}")


@contextmanager
def _exit_codes() -> Iterator[None]:
    """Turn what went wrong into one sentence on stderr and an exit code."""
    try:
        yield
    except InputError as error:
        _say(str(error))
        raise typer.Exit(2) from error
    except RunError as error:
        _say(str(error))
        raise typer.Exit(1) from error
    except KeyboardInterrupt as error:
        _say("interrupted before there was anything to keep")
        raise typer.Exit(1) from error


def _say(message: str) -> None:
    typer.echo(f"railcosim: {message}", err=True)
