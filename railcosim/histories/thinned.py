"""The histories that a scenario keeps, at equal distances, and its numbers from every step."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from orchestrator import PointBlocks

from ..dataset import constants, count, general_attributes, label_series, with_surfaces
from ..keep_section import KEPT
from ..result_file import read_netcdf
from ..signals import labels, signals_of
from ..strike import PASSAGE_NUMBERS, SIGNALS_OF_A_STRIKE, strike_numbers
from .history_file import HistoryFile
from .series import Series
from .stretches import Stretches
from .strike_points import StrikePoints

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from numpy.typing import NDArray

    from orchestrator import Outcome

    from ..scenario import Scenario
    from ..signals import ContactSide
    from ..surfaces.tables import UnevenSurfaces

FEWEST_POINTS = 2
"""Accepted points that make a result."""

ALWAYS = ("wheel_position", "sleeper_displacement", *SIGNALS_OF_A_STRIKE)
"""Series that are looked at whatever is kept."""


class ThinnedRecord:
    """Writes the kept signals while the run goes on; its memory does not grow with the steps.

    The result has those signals, interpolated between the accepted points at whole multiples of
    ``keep.spacing`` of ``distance``, over ``time``; the extremes of these and of the contact force
    over ``stretch``; the numbers of the summary as variables, of all steps as well.

    Parameters
    ----------
    scenario : Scenario
        What is run; its ``[keep]`` names signals.
    contact : {"vehicle", "track"}
        Which of the FMUs has the contacts.
    surfaces : UnevenSurfaces
        What the wheels roll over besides the flat.
    path : Path
        New file for the result.
    loads : bool
        Whether `label` returns all of it, or leaves the histories in the file.

    Raises
    ------
    RunError
        Where there is no room for the file.
    """

    def __init__(
        self,
        scenario: Scenario,
        contact: ContactSide,
        surfaces: UnevenSurfaces,
        *,
        path: Path,
        loads: bool,
    ) -> None:
        keep, there = scenario.keep, signals_of(scenario)
        names = {*keep.signals, *ALWAYS}
        self._scenario, self._path, self._loads = scenario, path, loads
        self._series = Series(
            scenario=scenario,
            contact=contact,
            signals=tuple(signal for signal in there if signal.name in names),
        )
        paths = self._series.paths
        self._columns = {name: column for column, name in enumerate(paths)}
        self.recorder = PointBlocks(paths, self._take)
        watched = dict.fromkeys(("contact_force", *keep.signals))
        self._stretches = Stretches(
            keep.stretch, [KEPT[name] for name in watched], end=scenario.run.departure
        )
        self._strike = StrikePoints()
        self._deepest = -math.inf
        self._last: dict[str, NDArray[np.float64]] = {}
        self._points = 0
        self._next, self._after = keep.grid(-scenario.run.approach, scenario.run.departure)
        self._head = self._template(surfaces)
        columns = sum(self._head.sizes[KEPT[name].dim] for name in watched)
        stretches = math.ceil(scenario.distance / keep.stretch) + 1
        self._file = HistoryFile(
            path,
            self._head,
            points=self._after - self._next,
            room=stretches * (2 * columns + self._head.sizes["wheel"] + 1) * np.float64().nbytes,
        )

    def label(
        self, outcome: Outcome, attributes: Mapping[str, str | int | float]
    ) -> xr.Dataset | None:
        """Finish the file and return the result, or None for fewer than two points."""
        if self._points < FEWEST_POINTS:
            return None
        if outcome.finished:
            self._write(self._last, self._after)
        keep = self._scenario.keep
        rest = self._stretches.as_dataset().assign(self._numbers())
        rest.attrs = {
            **general_attributes(self._scenario),
            "kept_signals": ", ".join(keep.signals),
            "kept_spacing": keep.grid_spacing,
            **attributes,
        }
        self._file.finish(rest)
        if self._loads:
            return read_netcdf(self._path, "check the disk")
        result = self._head.drop_dims("time").merge(rest)
        result.attrs = rest.attrs
        return result

    def close(self) -> None:
        """Let go of the file."""
        self._file.close()

    def _template(self, surfaces: UnevenSurfaces) -> xr.Dataset:
        """Label series without points, and what is known from the start."""
        none = np.empty(0)
        signals = [KEPT[name] for name in self._scenario.keep.signals]
        numbers = count(self._scenario)
        series = {signal.name: np.empty((0, numbers[signal.dim])) for signal in signals}
        labelled = label_series(self._scenario, signals, times=none, distance=none, series=series)
        return with_surfaces(labelled.assign(constants(self._scenario)), surfaces)

    def _take(self, times: NDArray[np.float64], values: NDArray[np.float64]) -> None:
        """Work on the next points."""
        scenario = self._scenario
        series = self._series.gather(lambda path: values[:, self._columns[path]])
        position = series["wheel_position"][:, scenario.flat.wheel - 1]
        block = {"time": times.copy(), "distance": position - scenario.flat_position} | series
        overlaps = bool(self._last)
        if overlaps:
            block = {name: np.concatenate([self._last[name], block[name]]) for name in block}
        self._points += len(times)
        self._deepest = max(self._deepest, float(block["sleeper_displacement"].max()))
        self._stretches.add(block, overlaps=overlaps)
        self._strike.add(block, overlaps=overlaps)
        self._write(block, math.floor(block["distance"][-1] / scenario.keep.grid_spacing) + 1)
        self._last = {name: column[-1:].copy() for name, column in block.items()}

    def _write(self, block: Mapping[str, NDArray[np.float64]], after: int) -> None:
        """Write the points of the grid up to one, interpolated between those of a block."""
        after = min(after, self._after)
        if after <= self._next:
            return
        points = self._scenario.keep.grid_spacing * np.arange(self._next, after, dtype=np.float64)
        self._next = after
        distance = block["distance"]

        def at_points(column: NDArray[np.float64]) -> NDArray[np.float64]:
            return np.asarray(np.interp(points, distance, column), dtype=np.float64)

        kept: dict[str, NDArray[np.float64]] = {
            name: np.stack([at_points(column) for column in block[name].T], axis=1)
            for name in self._scenario.keep.signals
        }
        self._file.append({"time": at_points(block["time"]), "distance": points} | kept)

    def _numbers(self) -> dict[str, object]:
        """Label the numbers of the summary, those that there are."""
        block = self._strike.series(like=self._last)
        signals = [signal for signal in self._series.signals if signal.name in ALWAYS]
        points = label_series(
            self._scenario,
            signals,
            times=block["time"],
            distance=block["distance"],
            series=block,
        )
        numbers = strike_numbers(points.assign(constants(self._scenario)))
        numbers["max_sleeper_displacement"] = self._deepest
        return {
            name: ((), value, labels(*PASSAGE_NUMBERS[name])) for name, value in numbers.items()
        }
