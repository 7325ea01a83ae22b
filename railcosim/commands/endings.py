"""How commands end: results kept, sentences on stderr, exit codes."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import typer

from ..errors import InputError, RunError
from ..output import write_dataset


@contextmanager
def keeping(output: Path | None) -> Iterator[None]:
    """Write what there is of a result when the run fails."""
    try:
        yield
    except RunError as error:
        if output is not None and error.result is not None:
            try:
                write_dataset(error.result, output)
            except RunError as another:
                raise RunError(f"{error}; {another}") from error
        raise


@contextmanager
def exit_codes() -> Iterator[None]:
    """Turn what went wrong into one sentence on stderr and an exit code."""
    try:
        yield
    except InputError as error:
        say(str(error))
        raise typer.Exit(2) from error
    except RunError as error:
        say(str(error))
        raise typer.Exit(1) from error
    except KeyboardInterrupt as error:
        say("interrupted before there was anything to keep")
        raise typer.Exit(1) from error


def say(message: str) -> None:
    """Write a sentence to stderr."""
    typer.echo(f"railcosim: {message}", err=True)
