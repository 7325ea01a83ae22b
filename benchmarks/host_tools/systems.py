"""The FMUs of the passage with contact on the track's side, each built when it is first needed."""

from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Literal, TypeAlias

from fmu_src.building import FmuPaths
from railcosim.builds import build_for
from railcosim.passage_package import ensure_package
from railcosim.scenario_file import read_scenario

from .passage import passage_job
from .scripts.job import Job

Build: TypeAlias = Literal["native 2.0", "native 3.0", "python 2.0"]
"""Which FMUs, and their version of FMI."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Systems:
    """TrackContact and Masses in one folder.

    Parameters
    ----------
    folder : Path
        Where they are kept.
    platforms : tuple of str, optional
        What native ones are compiled for; this machine without.
    """

    folder: Path
    platforms: tuple[str, ...] | None = None
    _built: dict[Build, FmuPaths] = field(default_factory=dict)

    def fmus(self, build: Build) -> FmuPaths:
        """Return the FMUs."""
        if build not in self._built:
            kind, version = build.split()
            make = partial(build_for, read_scenario(None, ()), kind, contact="track")
            self._built[build] = make(
                directory=self.folder / kind,
                fmi_version=3 if version == "3.0" else 2,
                platforms=self.platforms,
            )
        return self._built[build]

    def job(self, build: Build, *, packed: bool = False) -> Job:
        """Return the passage, set up by calls of the host or read by it from an SSP package."""
        fmus = self.fmus(build)
        if not packed:
            return passage_job(fmus)
        path = self.folder / f"Passage {build}.ssp"
        ensure_package(read_scenario(None, ()), fmus, path, contact="track")
        return passage_job(fmus, package=path)
