"""`railcosim replay`: how a run failed, once more."""

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from threadpoolctl import threadpool_limits

import orchestrator
from orchestrator.replay import open_replay, repeat

from ..errors import InputError, RunError
from ..terminal.repetition_report import repetition_numbers, repetition_table
from .endings import exit_codes
from .stdout import stdout_for_results


def replay(
    file: Annotated[Path, typer.Argument(metavar="FILE.replay", help="From a run that failed.")],
    *,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print what happened as one JSON object.")
    ] = False,
) -> None:
    """Repeat how a run failed; exit code 0 if it fails in the same way."""
    with exit_codes(), threadpool_limits(limits=1, user_api="blas"):
        try:
            with open_replay(file) as case, stdout_for_results():
                repetition = repeat(case)
        except orchestrator.InputError as error:
            raise InputError(str(error)) from error
        if as_json:
            numbers = repetition_numbers(case, repetition)
            typer.echo(json.dumps(numbers, indent=2, allow_nan=False))
        else:
            Console().print(repetition_table(case, repetition))
            typer.echo(repetition.message or "It did not fail.")
        if not repetition.reproduced:
            raise RunError(f"it did not end in the same way; the run ended so: {case.error}")
