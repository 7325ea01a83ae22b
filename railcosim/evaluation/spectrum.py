"""The spectrum of the contact forces."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np
import xarray as xr
from scipy import signal

from ..errors import InputError
from ..signals import labels
from .resampling import Samples, resample
from .settings import RESOLUTION, Evaluation

if TYPE_CHECKING:
    from numpy.typing import NDArray


def contact_force_spectrum(passage: xr.Dataset, settings: Evaluation | None = None) -> xr.Dataset:
    """Estimate amplitudes and power spectral density of every contact force after Welch.

    Segments that overlap by half, each without its mean under a Hann window, are averaged; the
    spectra are one-sided.

    Parameters
    ----------
    passage : xarray.Dataset
        Result of a passage.
    settings : Evaluation, optional
        Its ``rate`` and ``resolution``.

    Returns
    -------
    xarray.Dataset
        ``contact_force_amplitude`` [N], of the sine that would give the line, and
        ``contact_force_density`` [N2/Hz], dims (frequency, wheel), from the first line above zero
        up to the attribute ``frequency_limit`` [Hz]; see `resampling.Samples`.

    Raises
    ------
    InputError
        For a run that is shorter than a segment, or lines farther apart than the spectrum is long.
    """
    settings = settings or Evaluation()
    forces = passage["contact_force"].transpose("time", "wheel")
    samples = resample(passage["time"].to_numpy(), forces.to_numpy(), settings.rate)
    length = _segment(samples, settings)
    density = _welch(samples.values, settings.rate, length, "density")
    power = _welch(samples.values, settings.rate, length, "spectrum")
    frequency = np.arange(len(power)) * settings.rate / length
    shown = (frequency > 0.0) & (frequency <= samples.limit)
    lines = ("frequency", "wheel")
    density_name = "one-sided power spectral density of the contact force"
    return xr.Dataset(
        {
            "contact_force_amplitude": (
                lines,
                np.sqrt(2.0 * power[shown]),
                labels("N", "amplitude of the contact force"),
            ),
            "contact_force_density": (lines, density[shown], labels("N2 Hz-1", density_name)),
        },
        coords={
            "frequency": ("frequency", frequency[shown], labels("Hz", "frequency")),
            "wheel": passage["wheel"],
        },
        attrs={"sampling_rate": settings.rate, "frequency_limit": samples.limit},
    )


def _segment(samples: Samples, settings: Evaluation) -> int:
    """Return the samples of a segment."""
    finest = settings.rate / len(samples.x)
    resolution = settings.resolution or max(RESOLUTION, finest)
    if round(settings.rate / resolution) > len(samples.x):
        raise InputError(
            f"evaluation.resolution is {resolution:g} Hz but the run lasts only "
            f"{samples.x[-1] - samples.x[0]:g} s, which resolves {finest:.3g} Hz: ask for a "
            "coarser resolution"
        )
    if resolution > samples.limit:
        raise InputError(
            f"the lines of the spectrum are {resolution:g} Hz apart but it ends at "
            f"{samples.limit:.3g} Hz: ask for a finer evaluation.resolution, or evaluate a longer "
            "run"
        )
    return round(settings.rate / resolution)


def _welch(
    values: NDArray[np.float64],
    rate: float,
    length: int,
    scaling: Literal["density", "spectrum"],
) -> NDArray[np.float64]:
    """Average over segments of so many samples; shape (frequencies, ...)."""
    _, spectrum = signal.welch(
        values, fs=rate, window="hann", nperseg=length, scaling=scaling, axis=0
    )
    return spectrum
