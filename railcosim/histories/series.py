"""From the outputs of the FMUs to the time series of a result."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..dataset import count
from .passing_sleepers import show_sleepers

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from ..scenario import Scenario
    from ..signals import ContactSide, Signal


@dataclass(frozen=True, slots=True, kw_only=True)
class Series:
    """Signals of a passage, and which outputs they are gathered from.

    Attributes
    ----------
    scenario : Scenario
        What is run.
    contact : {"vehicle", "track"}
        Which of the FMUs has the contacts.
    signals : tuple of Signal
        Those wanted.
    """

    scenario: Scenario
    contact: ContactSide
    signals: tuple[Signal, ...]

    @property
    def paths(self) -> list[str]:
        """Outputs to observe, as ``component.variable``."""
        signals = [path for signal in self.signals for path in self._of(signal)]
        return signals + self._origins + self._window

    def gather(
        self, column: Callable[[str], NDArray[np.float64]]
    ) -> dict[str, NDArray[np.float64]]:
        """Put the columns of every signal together.

        Parameters
        ----------
        column : callable
            Gives the values of one of the `paths`, shape (times,).

        Returns
        -------
        dict of str to ndarray
            Of shape (times, wheels or sleepers or gauges), by the names of the signals.
        """
        series = {
            signal.name: np.stack([column(path) for path in self._of(signal)], axis=1)
            for signal in self.signals
        }
        for wheel, path in enumerate(self._origins):
            series["wheel_displacement"][:, wheel] += column(path)
        for path in self._window:
            show_sleepers(series, column(path), self.scenario)
        return series

    def _of(self, signal: Signal) -> list[str]:
        numbers = range(1, count(self.scenario)[signal.dim] + 1)
        return [signal.path(k, self.contact) for k in numbers]

    @property
    def _origins(self) -> list[str]:
        """Name what wheel displacements count from, where that is not the unloaded rail."""
        moves = any(signal.name == "wheel_displacement" for signal in self.signals)
        wheels = self.scenario.vehicle.wheels if moves and self.contact == "track" else 0
        return [f"track.wheel[{k}].static_displacement" for k in range(1, wheels + 1)]

    @property
    def _window(self) -> list[str]:
        """Name what tells which sleepers an endless track holds."""
        return ["track.window_position"] if self.scenario.track.endless else []
