"""`railcosim evaluate`: spectra, strains and loads from the result of a passage."""

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from ..errors import InputError
from ..evaluation.settings import TEST_SITE_BAYS, TEST_SITE_RATE, UIC60_FOOT, Evaluation, PartName
from ..figures.passage import describe
from ..output import TABLE_SUFFIXES, write_dataset, write_figure
from ..result_file import read_passage
from ..scenario_file import from_toml
from .endings import exit_codes, say
from .options import Json, Output, Plot, check_output, check_plot


def evaluate(
    result: Annotated[
        Path, typer.Argument(metavar="RESULT.nc", help="What run --output FILE.nc wrote.")
    ],
    *,
    part: Annotated[
        PartName | None, typer.Option(help="Only this part; tables and files then hold it alone.")
    ] = None,
    rate: Annotated[
        float, typer.Option(metavar="HZ", help="Sampling frequency of spectra and detector.")
    ] = TEST_SITE_RATE,
    resolution: Annotated[
        float | None,
        typer.Option(
            metavar="HZ", help="Distance of the lines of the spectrum; 10, if the run allows."
        ),
    ] = None,
    bays: Annotated[int, typer.Option(metavar="N", help="Bays of the detector.")] = TEST_SITE_BAYS,
    bay_share: Annotated[
        float, typer.Option(metavar="X", help="Part of a bay in which it sees a wheel.")
    ] = 1.0,
    gauge_depth: Annotated[
        float, typer.Option(metavar="M", help="Strain gauges below the neutral axis of the rail.")
    ] = UIC60_FOOT,
    output: Output = None,
    plot: Plot = None,
    as_json: Json = False,
) -> None:
    """Work out spectra, third octaves, detector record, strains and support loads of a passage."""
    # the library of filters and spectra takes as long to import as the rest of the program
    from ..evaluation.numbers import evaluation_table, plain_numbers  # noqa: PLC0415 - see above
    from ..evaluation.parts import PARTS  # noqa: PLC0415 - likewise
    from ..evaluation.parts import evaluate as work_out  # noqa: PLC0415 - likewise
    from ..figures.evaluation import draw_evaluation  # noqa: PLC0415 - likewise

    with exit_codes():
        settings = Evaluation(
            rate=rate,
            resolution=resolution,
            bays=bays,
            bay_share=bay_share,
            gauge_depth=gauge_depth,
        )
        check_output(output)
        if output is not None and part is None and output.suffix.lower() in TABLE_SUFFIXES:
            raise InputError(
                f"--output {output} holds one table but an evaluation makes several: choose one "
                "with --part, or write a .nc or .mat file"
            )
        check_plot(plot)
        found = work_out(read_passage(result), settings, part=part)
        if not found.attrs["complete"]:
            say("note: the run ended early; this is what there is of it")
        if found.attrs["unreliable"]:
            say(f"note: the run is wrong: {found.attrs['unreliable'].splitlines()[0]}")
        title = describe(from_toml(found.attrs["scenario"]))
        if output is not None:
            write_dataset(found, output, along=None if part is None else PARTS[part].along)
        if plot is not None:
            write_figure(draw_evaluation(found, part, title), plot)
        if as_json:
            numbers = plain_numbers(found, complete=part is not None)
            typer.echo(json.dumps(numbers, indent=2, allow_nan=False))
        else:
            Console().print(evaluation_table(found, title))
