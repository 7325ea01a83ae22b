"""Whether a measured receptance is one that four parameters of the supports can be fitted to."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..errors import InputError

if TYPE_CHECKING:
    from track_fmu.beam_element import FloatArray

    from ..receptance.measured import MeasuredReceptance

LEAST_POINTS = 20
"""Measured frequencies without which four parameters are not fitted."""

WRONG_SCALE = 30.0
"""Factor between measured and calculated amplitudes beyond which their unit must be another."""

WORST_FIT = np.log(2.0)
"""Root mean square of log-amplitudes that no longer is a fit: a factor of two, 6 dB."""


def check_points(measured: MeasuredReceptance, unknowns: int) -> None:
    """Refuse fewer measured frequencies than so many unknowns need.

    Raises
    ------
    InputError
        That says what to change.
    """
    points = len(measured.frequency)
    if points < LEAST_POINTS:
        raise InputError(
            f"{points} measured frequencies are too few to fit {unknowns} parameters: measure at "
            f"{LEAST_POINTS} or more, or widen --from and --to"
        )


def check_scale(calculated: FloatArray, measured: MeasuredReceptance) -> None:
    """Refuse measured amplitudes far from the calculated ones [m/N], whose unit must be another.

    Raises
    ------
    InputError
        That says what to change.
    """
    ratio = float(np.exp(np.median(np.log(measured.amplitude / calculated))))
    if not 1.0 / WRONG_SCALE < ratio < WRONG_SCALE:
        raise InputError(
            f"the measured amplitudes are about {ratio:.3g} times those of the track, more than a "
            f"factor of {WRONG_SCALE:g}: give displacement over force in m/N, or start from a "
            "closer track"
        )


def check_fit(amplitude: FloatArray) -> None:
    """Refuse a best fit whose log-amplitudes are too far from those measured.

    Raises
    ------
    InputError
        That says what to change.
    """
    misfit = root_mean_square(amplitude)
    if misfit > WORST_FIT:
        raise InputError(
            f"the best fit is off by a factor of {np.exp(misfit):.2g} (root mean square) but must "
            f"be within {np.exp(WORST_FIT):g}: check where it was measured (--position, "
            "--response), the other keys of the track and the range of frequency"
        )


def root_mean_square(values: FloatArray) -> float:
    """Root of the mean square of all values."""
    return float(np.sqrt(np.mean(values**2)))
