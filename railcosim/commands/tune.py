"""`railcosim tune`: parameters of the track fitted to measurements."""

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from ..ballast_curves import compute_curves
from ..figures.load_displacement import draw_load_displacement
from ..figures.receptance import draw_receptance
from ..load_displacement import LOADS, equidistant_loads
from ..output import check_writable, write_figure
from ..receptance.dataset import compute_receptance, frequency_range
from ..receptance.measured import read_measured
from ..receptance.points import parse_place
from ..receptance.study import ReceptanceStudy, midspan
from ..scenario_file import read_scenario
from ..secant_data import read_secant_data
from ..tuning.ballast import tune_to_secant_stiffness
from ..tuning.fragment import write_fragment
from ..tuning.receptance import tune_to_receptance
from ..tuning.report import (
    ballast_fit_numbers,
    ballast_rows,
    fit_table,
    receptance_fit_numbers,
    receptance_rows,
)
from .endings import exit_codes
from .options import Json, Overrides, Plot, ScenarioFile, check_plot
from .receptance import Position, Response

tune = typer.Typer(no_args_is_help=True, rich_markup_mode=None)

Fragment = Annotated[
    Path | None,
    typer.Option("--output", metavar="FILE.toml", help="The fitted track, for railcosim run."),
]


def _check_fragment(output: Path | None) -> None:
    """Find out before a fit whether its result can be written."""
    if output is not None:
        check_writable(output, option="--output", suffixes=(".toml",))


@tune.callback()
def _tune() -> None:
    """Fit parameters of the track to measurements."""


@tune.command("receptance")
def tune_receptance(
    measured: Annotated[
        Path,
        typer.Argument(
            metavar="MEASURED.csv", help="Frequency [Hz], amplitude [m/N], phase [deg]."
        ),
    ],
    scenario: ScenarioFile = None,
    *,
    overrides: Overrides = None,
    position: Position = None,
    response: Response = None,
    lowest: Annotated[
        float, typer.Option("--from", metavar="HZ", help="First frequency used.")
    ] = 0.0,
    highest: Annotated[
        float, typer.Option("--to", metavar="HZ", help="Last frequency used.")
    ] = float("inf"),
    hold: Annotated[
        list[str] | None, typer.Option(metavar="KEY", help="Not fitted, as in pad_damping.")
    ] = None,
    output: Fragment = None,
    plot: Plot = None,
    as_json: Json = False,
) -> None:
    """Fit stiffness and damping of pads and ballast to a measured receptance."""
    with exit_codes():
        case = read_scenario(scenario, overrides or ())
        load = midspan(case) if position is None else parse_place(position, "--position")
        observed = load if response is None else parse_place(response, "--response")
        _check_fragment(output)
        check_plot(plot)
        data = read_measured(measured).between(lowest, highest)
        tuned = tune_to_receptance(case, data, load=load, response=observed, hold=hold or ())
        if output is not None:
            write_fragment(
                output, tuned.scenario.track, estimates=tuned.estimates, source=measured.name
            )
        if plot is not None:
            study = ReceptanceStudy(scenario=tuned.scenario, load=load, response=observed)
            ends = float(data.frequency[0]), float(data.frequency[-1])
            curve = compute_receptance(study, frequency_range(*ends, 1000), ("direct",))
            write_figure(draw_receptance(curve, data), plot)
        numbers = receptance_fit_numbers(tuned, case.track)
        if as_json:
            typer.echo(json.dumps(numbers, indent=2, allow_nan=False))
        else:
            title = f"Track fitted to {measured.name}"
            Console().print(fit_table(numbers, receptance_rows(numbers), title))


@tune.command("ballast")
def tune_ballast(
    measured: Annotated[
        Path,
        typer.Argument(
            metavar="MEASURED.csv", help="Load on a rail seat [N], secant stiffness [N/m]."
        ),
    ],
    scenario: ScenarioFile = None,
    *,
    overrides: Overrides = None,
    fit_stiffness: Annotated[
        bool, typer.Option("--fit-stiffness", help="Fit track.ballast_stiffness too.")
    ] = False,
    largest_load: Annotated[
        float | None,
        typer.Option(metavar="N", help="Up to which it is fitted; the largest measured without."),
    ] = None,
    loads: Annotated[int, typer.Option(metavar="N", help="Loads that are fitted.")] = LOADS,
    output: Fragment = None,
    plot: Plot = None,
    as_json: Json = False,
) -> None:
    """Fit the state-dependent ballast to secant stiffness measured under several loads."""
    with exit_codes():
        case = read_scenario(scenario, overrides or ())
        _check_fragment(output)
        check_plot(plot)
        data = read_secant_data(measured)
        tuned = tune_to_secant_stiffness(
            case, data, fit_stiffness=fit_stiffness, largest_load=largest_load, loads=loads
        )
        if output is not None:
            write_fragment(
                output, tuned.scenario.track, estimates=tuned.estimates, source=measured.name
            )
        if plot is not None:
            at = equidistant_loads(tuned.largest_load, loads)
            curves = compute_curves(tuned.scenario, tuned.law, at)
            write_figure(draw_load_displacement(curves, data), plot)
        numbers = ballast_fit_numbers(tuned, case.track)
        if as_json:
            typer.echo(json.dumps(numbers, indent=2, allow_nan=False))
        else:
            title = f"Ballast fitted to {measured.name}"
            Console().print(fit_table(numbers, ballast_rows(numbers), title))
