"""`railcosim load-displacement`: the ballast's load over the sleeper's displacement."""

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from ..ballast_curves import compute_curves, curve_numbers, curve_table
from ..figures.load_displacement import draw_load_displacement
from ..load_displacement import LARGEST_LOAD, LOADS, SLOPE, SecantLaw, equidistant_loads
from ..output import write_dataset, write_figure
from ..scenario_file import read_scenario
from ..secant_data import read_secant_data
from .endings import exit_codes
from .options import Json, Output, Overrides, Plot, ScenarioFile, check_output, check_plot


def load_displacement(
    scenario: ScenarioFile = None,
    *,
    overrides: Overrides = None,
    slope: Annotated[
        float, typer.Option(metavar="X", help="Rise of the secant stiffness over the load [1/m].")
    ] = SLOPE,
    largest_load: Annotated[
        float, typer.Option(metavar="N", help="Largest load on a rail seat [N].")
    ] = LARGEST_LOAD,
    loads: Annotated[int, typer.Option(metavar="N", help="Loads that are fitted.")] = LOADS,
    frequency: Annotated[
        float, typer.Option(metavar="HZ", help="Frequency of the loss factor.")
    ] = 60.0,
    measured: Annotated[
        Path | None, typer.Option(metavar="FILE.csv", help="Load [N], secant stiffness [N/m].")
    ] = None,
    output: Output = None,
    plot: Plot = None,
    as_json: Json = False,
) -> None:
    """Compare the ballast of a scenario with the law measured by secant stiffness."""
    with exit_codes():
        case = read_scenario(scenario, overrides or ())
        check_output(output)
        check_plot(plot)
        law = SecantLaw(slope=slope, stiffness=case.track.ballast_stiffness)
        at = equidistant_loads(largest_load, loads)
        numbers = curve_numbers(case, law, at, frequency)
        points = None if measured is None else read_secant_data(measured)
        curves = compute_curves(case, law, at)
        if output is not None:
            write_dataset(curves, output)
        if plot is not None:
            write_figure(draw_load_displacement(curves, points), plot)
        if as_json:
            typer.echo(json.dumps(numbers, indent=2, allow_nan=False))
        else:
            Console().print(curve_table(numbers))
