"""A measured receptance and how far a calculated one is from it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..input_tables import read_as

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from track_fmu.beam_element import FloatArray

DECIBEL = 20.0 / float(np.log(10.0))
"""Decibels of a natural logarithm of amplitudes."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MeasuredReceptance:
    """A measured receptance.

    Attributes
    ----------
    frequency : (n,) float array
        Increasing [Hz].
    amplitude : (n,) float array
        Displacement over force [m/N].
    phase : (n,) float array, optional
        By which the displacement leads the force [deg]; negative for a passive track.

    Raises
    ------
    ValueError
        For a frequency or an amplitude that cannot be.
    """

    frequency: FloatArray
    amplitude: FloatArray
    phase: FloatArray | None = None

    def __post_init__(self) -> None:
        for name, values in (("frequency", self.frequency), ("amplitude", self.amplitude)):
            if np.any(values <= 0.0):
                raise ValueError(f"{name} is {values.min():g}, which must be above 0")
        falls = np.flatnonzero(np.diff(self.frequency) <= 0.0)
        if falls.size:
            where = falls[0]
            raise ValueError(
                f"the frequency {self.frequency[where]:g} Hz is followed by "
                f"{self.frequency[where + 1]:g} Hz but must increase from line to line"
            )

    def between(self, lowest: float, highest: float) -> MeasuredReceptance:
        """Return the part of it in a range of frequency [Hz], which may hold no point."""
        inside = (self.frequency >= lowest) & (self.frequency <= highest)
        return MeasuredReceptance(
            frequency=self.frequency[inside],
            amplitude=self.amplitude[inside],
            phase=None if self.phase is None else self.phase[inside],
        )


def read_measured(path: Path) -> MeasuredReceptance:
    """Read a CSV file: frequency [Hz], amplitude [m/N] and, if it has it, phase [deg].

    Raises
    ------
    InputError
        For a file that cannot be read or holds no receptance.
    """
    return read_as(MeasuredReceptance, str(path), ("frequency", "amplitude"), optional=("phase",))


def log_residual(
    calculated: NDArray[np.complex128], measured: MeasuredReceptance
) -> NDArray[np.float64]:
    """Natural logarithm of calculated over measured amplitude, then the phase difference [rad].

    Parameters
    ----------
    calculated : (n,) complex array
        Receptance at the measured frequencies [m/N].
    measured : MeasuredReceptance
        With or without phase.

    Returns
    -------
    (n,) or (2 n,) float array
        The phase differences, between -pi and pi, come after the amplitudes where there are any.
    """
    amplitude = np.log(np.abs(calculated) / measured.amplitude)
    if measured.phase is None:
        return np.asarray(amplitude)
    turn = np.angle(calculated * np.exp(-1j * np.deg2rad(measured.phase)))
    return np.concatenate([amplitude, turn])
