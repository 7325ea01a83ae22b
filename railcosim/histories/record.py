"""What is kept of a passage while it runs: every history, or those that the scenario names."""

from __future__ import annotations

import tempfile
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from orchestrator import Recorder

from ..dataset import assemble
from ..run_record import attempts
from ..signals import signals_of
from .series import Series
from .thinned import FEWEST_POINTS, ThinnedRecord

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    import xarray as xr

    from orchestrator import Outcome

    from ..scenario import Scenario
    from ..signals import ContactSide
    from ..surfaces.tables import UnevenSurfaces


class PassageRecord(Protocol):
    """Keeps a passage."""

    @property
    def recorder(self) -> Recorder:
        """Who sees the accepted points."""

    def label(
        self, outcome: Outcome, attributes: Mapping[str, str | int | float]
    ) -> xr.Dataset | None:
        """Return the result, or None where there is nothing to keep.

        Parameters
        ----------
        outcome : Outcome
            How the run went.
        attributes : mapping
            Versions, identities of the FMUs, statistics.
        """


class WholeRecord:
    """Keeps every history at every step.

    Parameters
    ----------
    scenario : Scenario
        What is run.
    contact : {"vehicle", "track"}
        Which of the FMUs has the contacts.
    surfaces : UnevenSurfaces
        What the wheels roll over besides the flat.
    """

    def __init__(self, scenario: Scenario, contact: ContactSide, surfaces: UnevenSurfaces) -> None:
        self._scenario, self._surfaces = scenario, surfaces
        self._series = Series(scenario=scenario, contact=contact, signals=signals_of(scenario))
        self.recorder = Recorder(self._series.paths)

    def label(
        self, outcome: Outcome, attributes: Mapping[str, str | int | float]
    ) -> xr.Dataset | None:
        """Return the result, see `dataset.assemble`, or None for fewer than two points."""
        if len(self.recorder.time) < FEWEST_POINTS:
            return None
        return assemble(
            self._scenario,
            times=self.recorder.time,
            series=self._series.gather(self.recorder.__getitem__),
            surfaces=self._surfaces,
            attempts=attempts(outcome),
            attributes=attributes,
        )


@contextmanager
def recording(
    scenario: Scenario,
    contact: ContactSide,
    surfaces: UnevenSurfaces,
    *,
    histories: Path | None = None,
) -> Iterator[PassageRecord]:
    """Yield what keeps a passage as its ``[keep]`` says.

    Parameters
    ----------
    scenario, contact, surfaces
        As of `WholeRecord`.
    histories : Path, optional
        New NetCDF file for the histories that are kept, of a scenario that keeps not all. Results
        hold them no more then; without, they are read into memory at the end.

    Raises
    ------
    RunError
        Where there is no room for them.
    """
    if scenario.keep.is_all:
        if histories is not None:
            raise ValueError("histories are written on the way only where [keep] names them")
        yield WholeRecord(scenario, contact, surfaces)
        return
    with ExitStack() as stack:
        if histories is None:
            folder = stack.enter_context(tempfile.TemporaryDirectory(prefix="railcosim-kept-"))
        record = ThinnedRecord(
            scenario,
            contact,
            surfaces,
            path=histories or Path(folder) / "kept.nc",
            loads=histories is None,
        )
        stack.callback(record.close)
        yield record
