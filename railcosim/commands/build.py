"""`railcosim build`: the FMUs of the paper's case and their systems."""

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated

import typer

from build_fmus import default_directory

from ..passage import build_for
from ..passage_package import ensure_package
from ..scenario import Scenario
from ..signals import ContactSide
from .endings import exit_codes, say

PACKAGE_NAMES: Mapping[ContactSide, str] = {
    "vehicle": "Passage.ssp",
    "track": "PassageContactOnTrack.ssp",
}
"""Files of the paper's case as a system of FMUs."""


def build(
    directory: Annotated[
        Path | None, typer.Option("--output", metavar="FOLDER", help="Where to; dist/ without.")
    ] = None,
) -> None:
    """Build the FMUs of the paper's case and its systems where they are missing or stale."""
    with exit_codes():
        folder = directory or default_directory()
        for contact, name in PACKAGE_NAMES.items():
            paths = build_for(Scenario(), contact=contact, directory=folder, notify=say)
            package = folder / name
            ensure_package(Scenario(), paths, package, contact=contact, notify=say)
            for path in (paths.track, paths.vehicle, package):
                typer.echo(path)
