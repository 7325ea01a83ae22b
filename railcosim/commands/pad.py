"""`railcosim pad`: hysteresis loops and dynamic stiffness of a viscoelastic rail pad."""

import json
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from ..figures.pad import draw_pad
from ..output import write_figure
from ..pad_curves import pad_loops
from ..scenario_file import read_scenario
from .endings import exit_codes
from .options import Json, Overrides, Plot, ScenarioFile, check_plot


def pad(
    scenario: ScenarioFile = None,
    *,
    overrides: Overrides = None,
    frequency: Annotated[
        float, typer.Option(metavar="HZ", help="Frequency of the deformation.")
    ] = 100.0,
    plot: Plot = None,
    as_json: Json = False,
) -> None:
    """Show the hysteresis and the dynamic stiffness of a rail pad over its preload."""
    with exit_codes():
        case = read_scenario(scenario, overrides or ())
        check_plot(plot)
        loops = pad_loops(case.track, frequency)
        if plot is not None:
            write_figure(draw_pad(loops), plot)
        names = ("preload", "static_stiffness", "dynamic_stiffness", "loss_factor")
        rows = [{name: getattr(loop, name) for name in names} for loop in loops]
        if as_json:
            numbers = {"frequency": frequency, "preloads": rows}
            typer.echo(json.dumps(numbers, indent=2, allow_nan=False))
            return
        table = Table(title=f"Rail pad at {frequency:g} Hz")
        for heading in ("preload [kN]", "static [MN/m]", "dynamic [MN/m]", "ratio", "loss factor"):
            table.add_column(heading, justify="right")
        for loop in loops:
            table.add_row(
                f"{1e-3 * loop.preload:.1f}",
                f"{1e-6 * loop.static_stiffness:.1f}",
                f"{1e-6 * loop.dynamic_stiffness:.1f}",
                f"{loop.dynamic_stiffness / loop.static_stiffness:.2f}",
                f"{loop.loss_factor:.3f}",
            )
        Console().print(table)
