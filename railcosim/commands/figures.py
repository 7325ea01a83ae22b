"""`railcosim figures`: the figures of the paper's study."""

import json
import time
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from ..ballast_curves import compute_curves
from ..builds import usual_build
from ..errors import InputError
from ..load_displacement import LARGEST_LOAD, LOADS, SecantLaw, equidistant_loads
from ..notes import notes
from ..output import FIGURE_SUFFIXES, check_writable, replacing, write_dataset, write_figure
from ..paper_figures.captions import captions_text
from ..paper_figures.making import (
    Measured,
    PaperFigure,
    ballast_figure,
    force_figure,
    histories_figure,
    moment_figure,
    plain_numbers,
    receptance_figure,
)
from ..paper_figures.measured_peaks import read_measured_peaks
from ..paper_figures.passages import full_passages, parse_speeds, peaks_of, speed_study
from ..receptance.dataset import compute_receptance, frequency_range
from ..receptance.measured import read_measured
from ..receptance.study import ReceptanceStudy, midspan
from ..scenario import Scenario
from ..scenario_file import read_scenario
from ..secant_data import read_secant_data
from ..sweep import Study, check_study, run_study
from ..sweep.progress import sweep_bar
from ..vehicle_section import DEFAULT_SPEED_KMH
from .endings import exit_codes, say
from .options import FmuKind, Json, Overrides, Quiet
from .stdout import stdout_for_results

KINDS = (".pdf", ".png")
"""Files of every figure."""

STORE, PEAKS, CAPTIONS = "passages", "peaks.nc", "captions.md"
"""What is in the folder besides the figures."""

RECEPTANCE = (10.0, 2000.0, 1000)
"""First and last frequency of the receptance [Hz] and their number."""


def figures(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="Where to; made if missing.")],
    *,
    speeds: Annotated[
        str, typer.Option(metavar="FROM:TO:STEP", help="Speeds [km/h], or several with commas.")
    ] = "5:100:5",
    measured: Annotated[
        list[Path] | None,
        typer.Option(
            metavar="FILE.csv",
            help="Speed [km/h], peak force [N], moment [N m] to draw; may be repeated.",
        ),
    ] = None,
    measured_receptance: Annotated[
        Path | None,
        typer.Option(metavar="FILE.csv", help="Frequency [Hz], amplitude [m/N], phase [deg]."),
    ] = None,
    measured_ballast: Annotated[
        Path | None, typer.Option(metavar="FILE.csv", help="Load [N], secant stiffness [N/m].")
    ] = None,
    overrides: Overrides = None,
    fmus: Annotated[
        FmuKind | None, typer.Option(help="Which build of the FMUs runs; as in run without.")
    ] = None,
    workers: Annotated[
        int | None,
        typer.Option(metavar="N", help="Processes on this machine; one for every core without."),
    ] = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Draw the paper's figures of both tracks; started again, no passage runs twice."""
    started = time.perf_counter()
    with exit_codes():
        scenario = read_scenario(None, overrides or ())
        build = usual_build("vehicle") if fmus is None else fmus.value
        study = speed_study(scenario, parse_speeds(speeds), build)
        given = Measured(
            peaks=tuple(read_measured_peaks(path) for path in measured or ()),
            receptance=None if measured_receptance is None else read_measured(measured_receptance),
            ballast=None if measured_ballast is None else read_secant_data(measured_ballast),
        )
        check_study(study, workers=workers)
        _check_folder(folder)
        for note in notes(scenario):
            say(f"note: {note}")
        with stdout_for_results():
            made, numbers = _make(
                scenario, study, given, folder, build=build, workers=workers, quiet=quiet
            )
        for item in made:
            for kind in KINDS:
                write_figure(item.figure, folder / f"{item.name}{kind}")
        with replacing(folder / CAPTIONS) as temporary:
            text = captions_text([(item.name, item.caption) for item in made])
            temporary.write_text(text, encoding="utf-8")
        wall_time = time.perf_counter() - started
        if as_json:
            listed = [
                {
                    "files": [str(folder / f"{item.name}{kind}") for kind in KINDS],
                    "caption": item.caption,
                }
                for item in made
            ]
            answer = {"figures": listed, **numbers, "wall_time": wall_time}
            typer.echo(json.dumps(answer, indent=2, allow_nan=False))
        elif not quiet:
            Console().print(_table(made, folder, wall_time))


def _check_folder(folder: Path) -> None:
    """Make the folder, or find out that it cannot be written to."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"DIR {folder} cannot be made ({error.strerror}): name another") from error
    check_writable(folder / f"figure{KINDS[0]}", option="DIR", suffixes=FIGURE_SUFFIXES)


def _make(
    scenario: Scenario,
    study: Study,
    measured: Measured,
    folder: Path,
    *,
    build: str,
    workers: int | None,
    quiet: bool,
) -> tuple[list[PaperFigure], dict[str, object]]:
    """Run and calculate what there is to draw, and draw it."""
    notify = None if quiet else say
    with sweep_bar(Console(stderr=True, quiet=quiet)) as report:
        result = run_study(
            study, store=folder / STORE, workers=workers, notify=notify, report=report
        )
    peaks = peaks_of(result)
    write_dataset(result, folder / PEAKS)
    passages = full_passages(scenario, DEFAULT_SPEED_KMH, fmus=build, notify=notify)
    place = midspan(scenario)
    receptance = compute_receptance(
        ReceptanceStudy(scenario=scenario, load=place, response=place),
        frequency_range(*RECEPTANCE),
    )
    law = SecantLaw(stiffness=scenario.track.ballast_stiffness)
    curves = compute_curves(scenario, law, equidistant_loads(LARGEST_LOAD, LOADS))
    made = [
        receptance_figure(scenario, receptance, measured),
        ballast_figure(curves, measured),
        force_figure(scenario, peaks, measured),
        moment_figure(scenario, peaks, measured),
        histories_figure(scenario, passages, DEFAULT_SPEED_KMH),
    ]
    return made, plain_numbers(peaks, receptance)


def _table(made: list[PaperFigure], folder: Path, wall_time: float) -> Table:
    """List what was drawn."""
    table = Table(title=f"Figures in {folder}", caption=f"{wall_time:.0f} s", show_header=False)
    table.add_column("name", no_wrap=True)
    table.add_column("caption")
    for item in made:
        table.add_row(item.name, item.caption)
    return table
