"""`railcosim build`: the FMUs of the paper's case and their systems."""

from pathlib import Path
from typing import Annotated

import typer

from fmu_src.building import folder_of
from fmu_src.native.compiler import TARGETS

from ..errors import InputError
from ..paper_case import build_native, build_python
from .endings import exit_codes, say
from .options import FmuKind


def build(
    directory: Annotated[
        Path | None,
        typer.Option("--output", metavar="FOLDER", help="Where to; dist/ or dist/native/ without."),
    ] = None,
    kind: Annotated[FmuKind, typer.Option(help="Which build.")] = FmuKind.PYTHON,
    platform: Annotated[
        list[str] | None,
        typer.Option(
            metavar="|".join(TARGETS), help="Of native FMUs; may be repeated; all without."
        ),
    ] = None,
) -> None:
    """Build the FMUs of the paper's case and its systems where they are missing or stale."""
    with exit_codes():
        folder = directory or folder_of(kind.value)
        if kind is FmuKind.NATIVE:
            written = build_native(folder, platform or tuple(TARGETS), notify=say)
        elif platform:
            raise InputError("--platform is for --kind native: leave it out")
        else:
            written = build_python(folder, notify=say)
        for path in written:
            typer.echo(path)
