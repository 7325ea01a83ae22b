"""A receptance as labelled arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from ..errors import InputError
from ..run_record import programs
from ..scenario_file import to_toml
from .study import METHODS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from track_fmu.beam_element import FloatArray

    from .study import ReceptanceStudy

MOST_POINTS = 100_000
"""Frequencies that are solved within a minute."""


def frequency_range(lowest: float, highest: float, points: int) -> FloatArray:
    """Frequencies at equal ratios [Hz].

    Raises
    ------
    InputError
        For a range that is none.
    """
    if not (np.isfinite(highest) and 0.0 < lowest < highest):
        raise InputError(
            f"frequencies from {lowest:g} Hz to {highest:g} Hz are no range: begin above 0 Hz and "
            "end higher"
        )
    if not 3 <= points <= MOST_POINTS:
        raise InputError(f"{points} frequencies are asked for: choose 3 to {MOST_POINTS}")
    return np.geomspace(lowest, highest, points)


def compute_receptance(
    study: ReceptanceStudy, frequencies: FloatArray, methods: Sequence[str] = METHODS
) -> xr.Dataset:
    """Compute and label a receptance.

    Parameters
    ----------
    study : ReceptanceStudy
        What is loaded where.
    frequencies : (n,) float array
        Increasing [Hz].
    methods : sequence of str
        Of `METHODS`.

    Returns
    -------
    xarray.Dataset
        Amplitude and phase over frequency and ``solution`` (one of the methods); the resonances
        in the first; static flexibilities.

    Raises
    ------
    RunError
        If there is no equilibrium under the preload.
    """
    curves = {method: study.receptance(frequencies, method) for method in methods}
    table = np.stack(list(curves.values()), axis=1)
    peaks = study.peaks(float(frequencies[0]), float(frequencies[-1]), methods[0])
    return xr.Dataset(
        {
            "amplitude": (
                ("frequency", "solution"),
                np.abs(table),
                {"units": "m/N", "long_name": "displacement over force"},
            ),
            "phase": (
                ("frequency", "solution"),
                np.rad2deg(np.angle(table)),
                {"units": "degree", "long_name": "phase by which the displacement leads the force"},
            ),
            "static_flexibility": (
                ("solution",),
                [float(study.receptance(np.zeros(1), method)[0].real) for method in methods],
                {"units": "m/N", "long_name": "displacement over a standing force"},
            ),
            "peak_frequency": (
                ("peak",),
                [peak.frequency for peak in peaks],
                {"units": "Hz", "long_name": "resonance frequency"},
            ),
            "peak_amplitude": (
                ("peak",),
                [peak.amplitude for peak in peaks],
                {"units": "m/N", "long_name": "displacement over force at a resonance"},
            ),
        },
        coords={
            "frequency": ("frequency", frequencies, {"units": "Hz", "long_name": "frequency"}),
            "solution": (
                "solution",
                list(methods),
                {"units": "1", "long_name": "direct from the matrices or modal"},
            ),
        },
        attrs={
            "Conventions": "CF-1.11",
            "title": "Receptance of the track",
            "load": str(study.load),
            "response": str(study.response),
            "preload": study.preload,
            "scenario": to_toml(study.scenario),
            **programs(),
        },
    )
