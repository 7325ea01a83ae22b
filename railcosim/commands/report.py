"""`railcosim report`: one self-contained page about a passage."""

import importlib.util
import json
from collections.abc import Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
import xarray as xr
from rich.console import Console

from ..builds import usual_build
from ..errors import InputError, RunError
from ..notes import notes
from ..output import check_writable, replacing
from ..passage import run_passage
from ..result_check import check_result
from ..result_file import read_passage
from ..scenario import Scenario
from ..scenario_file import read_scenario
from ..summary import summarise
from ..terminal.progress import progress_bar
from .endings import exit_codes, say
from .options import ContactName, FmuKind, Quiet
from .stdout import stdout_for_results

if TYPE_CHECKING:
    from ..report.convergence import Convergence, Runner

LIBRARIES = ("plotly", "jinja2", "markupsafe")
"""What the page is made with."""


def report(
    source: Annotated[
        Path | None,
        typer.Argument(
            metavar="RESULT.nc|SCENARIO.toml", help="What to show; the paper's case without."
        ),
    ] = None,
    *,
    output: Annotated[Path, typer.Option(metavar="FILE.html", help="The page.")] = Path(
        "report.html"
    ),
    overrides: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="KEY=VALUE", help="Replace a key, as in flat.depth=1e-3."),
    ] = None,
    fmus: Annotated[
        FmuKind | None,
        typer.Option(help="Which build of the FMUs runs; native, if it has been built, without."),
    ] = None,
    contact: Annotated[
        ContactName | None, typer.Option(help="Which FMU has the contacts; vehicle without.")
    ] = None,
    convergence: Annotated[
        bool, typer.Option("--convergence", help="Run the passage with smaller steps, too.")
    ] = False,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the numbers as one JSON object, SI units.")
    ] = False,
    quiet: Quiet = False,
) -> None:
    """Show a passage on one HTML page: figures, step log, convergence and an animation."""
    with exit_codes():
        _check_libraries()
        check_writable(output, option="--output", suffixes=(".html",))
        passage, run = _passage(
            source, overrides or (), fmus=fmus, contact=contact, output=output, quiet=quiet
        )
        studied = None
        if convergence and passage.attrs["complete"] and not passage.attrs["unreliable"]:
            studied = _study(passage, run, output)
        _write(passage, studied, output)
        if as_json:
            numbers = {
                "page": str(output),
                "bytes": output.stat().st_size,
                "summary": summarise(passage).as_dict(),
                "convergence": None if studied is None else asdict(studied),
            }
            typer.echo(json.dumps(numbers, indent=2, allow_nan=False))
        elif not quiet:
            typer.echo(f"{output} ({output.stat().st_size / 1e6:.1f} MB)")
        check_result(passage)


def _check_libraries() -> None:
    """Find out before a run whether a page can be made."""
    for name in LIBRARIES:
        if importlib.util.find_spec(name) is None:
            raise InputError(
                f"a report needs the library {name}, which is not there: "
                "pip install 'railcosim[report]'"
            )


def _passage(
    source: Path | None,
    overrides: Sequence[str],
    *,
    fmus: FmuKind | None,
    contact: ContactName | None,
    output: Path,
    quiet: bool,
) -> "tuple[xr.Dataset, Runner]":
    """Read a result or run a scenario; return with it what runs it at other settings."""
    if source is not None and source.suffix.lower() == ".nc":
        if overrides or contact is not None:
            raise InputError(
                f"--set and --contact cannot change {source}, which is a result: leave them out or "
                "give a scenario"
            )
        passage = read_passage(source)
        side = ContactName(passage.attrs["contact"])
        return passage, _runner(fmus, side, quiet=quiet)
    scenario = read_scenario(source, overrides)
    scenario.keep.need_all("railcosim report")
    side = contact or ContactName.VEHICLE
    for note in notes(scenario, side.value):
        say(f"note: {note}")
    run = _runner(fmus, side, quiet=quiet)
    try:
        return run(scenario, "passage"), run
    except RunError as error:
        if error.result is not None:
            _write(error.result, None, output)
        raise


def _runner(fmus: FmuKind | None, contact: ContactName, *, quiet: bool) -> "Runner":
    """Return what runs passages, with a progress bar on stderr or without a word."""
    build = usual_build(contact.value) if fmus is None else fmus.value

    def run(scenario: Scenario, label: str) -> xr.Dataset:
        case = partial(run_passage, scenario, fmus=build, contact=contact.value)
        with stdout_for_results():
            if quiet:
                return case()
            with progress_bar(Console(stderr=True), label) as bar:
                return case(notify=say, report=bar)

    return run


def _study(passage: xr.Dataset, run: "Runner", output: Path) -> "Convergence":
    """Run the other settings; where that fails, write the page without them."""
    from ..report.convergence import study  # noqa: PLC0415 - beside the page, which needs an extra

    try:
        return study(passage, run)
    except RunError:
        _write(passage, None, output)
        raise


def _write(passage: xr.Dataset, studied: "Convergence | None", output: Path) -> None:
    from ..report.page import write_page  # noqa: PLC0415 - of an extra, looked for before

    page = write_page(passage, studied)
    with replacing(output) as temporary:
        temporary.write_text(page, encoding="utf-8", newline="\n")
