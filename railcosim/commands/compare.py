"""`railcosim compare`: a result beside its baseline."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from ..errors import RunError
from ..output import FIGURE_SUFFIXES, check_writable
from .endings import exit_codes, say


def compare(
    result: Annotated[Path, typer.Argument(metavar="RESULT", help="A .nc, .csv or .parquet file.")],
    baseline: Annotated[Path, typer.Argument(metavar="BASELINE", help="What it should be.")],
    *,
    tolerances: Annotated[
        Path | None, typer.Option(metavar="FILE.toml", help="What is allowed; 0.1 % without.")
    ] = None,
    signals: Annotated[
        list[str] | None,
        typer.Option(metavar="PATTERN", help="Compare these only, * is any text; may be repeated."),
    ] = None,
    plot: Annotated[
        Path | None,
        typer.Option(metavar="FILE|FOLDER", help="Figure of what differs, or one per signal."),
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the numbers as one JSON object, SI units.")
    ] = False,
) -> None:
    """Compare two results signal by signal; exit code 0 if they agree, 1 if they differ."""
    # scipy.signal takes half a second to import, which the other commands do not need
    from .. import comparison as regression  # noqa: PLC0415 - see above

    with exit_codes():
        if plot is not None:
            figure = plot / "signal.png" if plot.is_dir() else plot
            check_writable(figure, option="--plot", suffixes=FIGURE_SUFFIXES)
        allowed = None if tolerances is None else regression.read_tolerances(tolerances)
        new, old = regression.read_recording(result), regression.read_recording(baseline)
        compared = regression.compare(new, old, allowed, signals=signals or ())
        if as_json:
            typer.echo(json.dumps(compared.numbers(), indent=2, allow_nan=False))
        else:
            Console().print(regression.comparison_table(compared))
            if compared.agrees:
                typer.echo(compared.verdict())
        if plot is not None:
            for path in regression.write_overlays(new, old, compared, plot):
                say(f"written: {path}")
        if not compared.agrees:
            raise RunError(compared.verdict())
