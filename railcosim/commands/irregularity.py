"""`railcosim irregularity`: the rail and the wheels of a scenario, without a run."""

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from ..errors import InputError
from ..figures.irregularity import draw_surfaces
from ..output import check_writable, write_dataset, write_figure
from ..scenario_file import read_scenario
from ..surfaces.dataset import surface_dataset
from ..surfaces.report import surface_numbers, surface_report
from ..surfaces.tables import compose, write_tables
from .endings import exit_codes
from .options import Json, Overrides, Plot, ScenarioFile, check_plot

Tables = Annotated[
    Path | None,
    typer.Option(metavar="FOLDER", help="Tables for the FMUs: rail.csv, wheel1.csv and so on."),
]
NetCdf = Annotated[Path | None, typer.Option(metavar="FILE.nc", help="Both as labelled arrays.")]


def irregularity(
    scenario: ScenarioFile = None,
    *,
    overrides: Overrides = None,
    tables: Tables = None,
    output: NetCdf = None,
    plot: Plot = None,
    as_json: Json = False,
) -> None:
    """Compose what rail and wheels are uneven by; write its tables, draw its spectrum."""
    with exit_codes():
        case = read_scenario(scenario, overrides or ())
        if output is not None:
            check_writable(output, option="--output", suffixes=(".nc",))
        check_plot(plot)
        if tables is not None and not tables.is_dir():
            raise InputError(f"--tables {tables} is no folder: create it first")
        surfaces = compose(case)
        if surfaces.are_smooth:
            raise InputError(
                "rail and wheels of this scenario are smooth: give it tables [[irregularity]] or "
                "[[wheel_defect]]"
            )
        if tables is not None:
            write_tables(tables, surfaces)
        data = surface_dataset(surfaces)
        if output is not None:
            write_dataset(data, output)
        if plot is not None:
            write_figure(draw_surfaces(case, surfaces), plot)
        numbers = surface_numbers(case, surfaces)
        if as_json:
            typer.echo(json.dumps(numbers, indent=2, allow_nan=False))
        else:
            Console().print(surface_report(numbers))
