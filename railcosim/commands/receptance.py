"""`railcosim receptance`: displacement over force of the track against frequency."""

import json
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from ..figures.receptance import draw_receptance
from ..output import write_dataset, write_figure
from ..receptance.dataset import compute_receptance, frequency_range
from ..receptance.measured import read_measured
from ..receptance.points import parse_place
from ..receptance.report import measured_deviation, receptance_numbers, receptance_table
from ..receptance.study import METHODS, ReceptanceStudy, midspan
from ..scenario_file import read_scenario
from .endings import exit_codes
from .options import Json, Output, Overrides, Plot, ScenarioFile, check_output, check_plot

Position = Annotated[
    str | None,
    typer.Option(metavar="X|sleeper:N", help="Where the force acts [m]; at midspan without."),
]
Response = Annotated[
    str | None,
    typer.Option(metavar="X|sleeper:N", help="Where the displacement is taken [m]."),
]


class Method(StrEnum):
    """How a receptance is computed."""

    DIRECT = "direct"
    MODAL = "modal"
    BOTH = "both"


def receptance(
    scenario: ScenarioFile = None,
    *,
    overrides: Overrides = None,
    position: Position = None,
    response: Response = None,
    preload: Annotated[
        float, typer.Option(metavar="N", help="Standing load on the rail at the force [N].")
    ] = 0.0,
    lowest: Annotated[float, typer.Option("--from", metavar="HZ", help="First frequency.")] = 10.0,
    highest: Annotated[float, typer.Option("--to", metavar="HZ", help="Last frequency.")] = 2000.0,
    points: Annotated[int, typer.Option(metavar="N", help="Frequencies, at equal ratios.")] = 1000,
    method: Annotated[Method, typer.Option(help="Full matrices or modes.")] = Method.BOTH,
    measured: Annotated[
        Path | None,
        typer.Option(metavar="FILE.csv", help="Frequency [Hz], amplitude [m/N], phase [deg]."),
    ] = None,
    output: Output = None,
    plot: Plot = None,
    as_json: Json = False,
) -> None:
    """Compute how far the track gives under a vibrating force, over its frequency."""
    with exit_codes():
        case = read_scenario(scenario, overrides or ())
        load = midspan(case) if position is None else parse_place(position, "--position")
        study = ReceptanceStudy(
            scenario=case,
            load=load,
            response=load if response is None else parse_place(response, "--response"),
            preload=preload,
        )
        frequencies = frequency_range(lowest, highest, points)
        check_output(output)
        check_plot(plot)
        reference = None if measured is None else read_measured(measured)
        methods = METHODS if method is Method.BOTH else (method.value,)
        result = compute_receptance(study, frequencies, methods)
        deviation = None if reference is None else measured_deviation(study, reference)
        if output is not None:
            write_dataset(result, output)
        if plot is not None:
            write_figure(draw_receptance(result, reference), plot)
        numbers = receptance_numbers(result, deviation)
        if as_json:
            typer.echo(json.dumps(numbers, indent=2, allow_nan=False))
        else:
            Console().print(receptance_table(numbers))
