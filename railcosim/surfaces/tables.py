"""Tables that the FMUs read of what is composed, in a folder for the time of a run."""

from __future__ import annotations

import shutil
import tempfile
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from vehicle_fmu.out_of_roundness import OutOfRoundness

from ..errors import RunError
from ..output import replacing
from ..support_values import support_properties
from .files import SurfaceFiles
from .rail import compose_rail
from .wheels import compose_treads

if TYPE_CHECKING:
    from collections.abc import Iterator

    from vehicle_fmu.irregularity import RailIrregularity

    from ..scenario import Scenario


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UnevenSurfaces:
    """What the wheels roll over, besides the flat.

    Attributes
    ----------
    rail : RailIrregularity or None
        None for a smooth rail.
    treads : tuple of OutOfRoundness or None
        One a wheel, None for a round one; empty where all are round.
    """

    rail: RailIrregularity | None
    treads: tuple[OutOfRoundness | None, ...]

    @property
    def are_smooth(self) -> bool:
        """Whether there is nothing but the flat."""
        return self.rail is None and not self.treads


def compose(scenario: Scenario) -> UnevenSurfaces:
    """Compose rail and treads; see `compose_rail` and `compose_treads`."""
    return UnevenSurfaces(rail=compose_rail(scenario), treads=compose_treads(scenario))


@contextmanager
def written(
    scenario: Scenario, surfaces: UnevenSurfaces, *, replay: Path | None = None
) -> Iterator[SurfaceFiles]:
    """Write what is composed to files that are there within the block.

    Parameters
    ----------
    scenario : Scenario
        Names the file of the rail that is used as it is.
    surfaces : UnevenSurfaces
        As `compose` returns them for it.
    replay : Path, optional
        Replay file of the run. The folder of the tables is then one beside it of the ending
        ``.tables``, and stays if the block raises `RunError` and has written the replay file, whose
        saved states name its files.

    Raises
    ------
    RunError
        Where the files cannot be written.
    """
    named = scenario.vehicle.rail_irregularity
    rail = None if named else surfaces.rail
    differing = scenario.track.endless and scenario.variation.is_any
    supports = scenario.track.supports if scenario.track.endless else ""
    if rail is None and not surfaces.treads and not differing:
        treads = ("",) * scenario.vehicle.wheels
        yield SurfaceFiles(rail=named, treads=treads, supports=supports)
        return
    with _folder(replay) as folder:
        files = write_tables(folder, replace(surfaces, rail=rail))
        treads = files.treads or ("",) * scenario.vehicle.wheels
        if differing:
            supports = write_supports(folder / "supports.csv", scenario)
        yield SurfaceFiles(rail=named or files.rail, treads=treads, supports=supports)


def write_tables(folder: Path, surfaces: UnevenSurfaces) -> SurfaceFiles:
    """Write ``rail.csv`` and for every wheel that is not round ``wheel1.csv`` and so on.

    Raises
    ------
    RunError
        Where they cannot be written.
    """
    return SurfaceFiles(
        rail=_write(folder / "rail.csv", "position", surfaces.rail),
        treads=tuple(
            _write(folder / f"wheel{k}.csv", "angle", tread)
            for k, tread in enumerate(surfaces.treads, start=1)
        ),
    )


def write_supports(path: Path, scenario: Scenario) -> str:
    """Write what the supports have that a passage reaches; return the path.

    Raises
    ------
    RunError
        Where it cannot be written.
    """
    columns = support_properties(scenario)
    rows = zip(*(values.tolist() for values in columns.values()), strict=True)
    with replacing(path) as temporary, temporary.open("w", encoding="ascii") as file:
        file.write(f"number,{','.join(columns)}\n")
        for number, row in enumerate(rows, start=1):
            file.write(f"{number},{','.join(map(repr, row))}\n")
    return str(path)


@contextmanager
def _folder(replay: Path | None) -> Iterator[Path]:
    """Make the folder of the tables and remove it again, unless a replay needs it."""
    if replay is None:
        with tempfile.TemporaryDirectory(prefix="railcosim-tables-") as name:
            yield Path(name)
        return
    folder = replay.with_suffix(".tables").resolve()
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        raise RunError(
            f"the folder {folder} for the tables of a run cannot be made: "
            f"{error.strerror or error}; make its own folder writable"
        ) from error
    is_needed = False
    try:
        yield folder
    except RunError:
        is_needed = replay.is_file()
        raise
    finally:
        if not is_needed:
            shutil.rmtree(folder)


def _write(path: Path, name: str, table: RailIrregularity | OutOfRoundness | None) -> str:
    """Write a table in numbers that keep all their bits; return its path, nothing of none."""
    if table is None:
        return ""
    x = table.angle if isinstance(table, OutOfRoundness) else table.position
    rows = (f"{a!r},{b!r}\n" for a, b in zip(x.tolist(), table.drop.tolist(), strict=True))
    with replacing(path) as temporary, temporary.open("w", encoding="ascii") as file:
        file.write(f"{name},drop\n")
        file.writelines(rows)
    return str(path)
