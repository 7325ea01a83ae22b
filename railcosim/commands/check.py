"""`railcosim check`: what an FMU claims, tried."""

import json
from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

import orchestrator
from orchestrator import check_fmu
from orchestrator.isolated import DEFAULT_TIMEOUT

from ..errors import InputError, RunError
from ..terminal.verdict_table import verdict_table
from .endings import exit_codes


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
    with exit_codes():
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
