"""One-third-octave bands of the contact forces, over frequency and over wavelength."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr
from scipy import signal

from ..errors import InputError
from ..signals import labels
from .resampling import resample
from .settings import Evaluation

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .resampling import Samples

LINES_IN_A_BAND = 3
"""Fewest lines of the run's own spectrum that make a band."""

NOMINAL = (1.0, 1.25, 1.6, 2.0, 2.5, 3.15, 4.0, 5.0, 6.3, 8.0)
"""Nominal midband frequencies of a decade (IEC 61260-1, annex E)."""


def third_octaves(passage: xr.Dataset, settings: Evaluation | None = None) -> xr.Dataset:
    """Work out the effective value of every contact force in one-third-octave bands.

    The bands are those of IEC 61260-1 to base 10. The values are those of ideal filters over the
    whole run without its mean, so that their squares add up to the mean square.

    Parameters
    ----------
    passage : xarray.Dataset
        Result of a passage.
    settings : Evaluation, optional
        Its ``rate``.

    Returns
    -------
    xarray.Dataset
        ``contact_force_band`` [N], dims (band_frequency, wheel), with the nominal frequencies,
        for the bands that the run is long enough for and that end below the attribute
        ``frequency_limit`` [Hz].

    Raises
    ------
    InputError
        For a run too short for any band.
    """
    settings = settings or Evaluation()
    samples = resample(passage["time"].to_numpy(), _forces(passage), settings.rate)
    numbers = _bands_of(samples)
    return xr.Dataset(
        {"contact_force_band": _variable("band_frequency", _band_values(samples, numbers))},
        coords={
            "band_frequency": (
                "band_frequency",
                midband(numbers),
                labels("Hz", "exact midband frequency"),
            ),
            "nominal_frequency": (
                "band_frequency",
                nominal(numbers),
                labels("Hz", "nominal midband frequency"),
            ),
            "wheel": passage["wheel"],
        },
        attrs={"sampling_rate": settings.rate, "frequency_limit": samples.limit},
    )


def wavelength_bands(passage: xr.Dataset, settings: Evaluation | None = None) -> xr.Dataset:
    """Do the same over the distance rolled, for wavelengths; see `third_octaves`.

    Returns
    -------
    xarray.Dataset
        ``contact_force_wavelength_band`` [N], dims (band_wavelength, wheel), longest first, down
        to the attribute ``wavelength_limit`` [m]. The samples are as far apart as the fastest
        wheel rolls in one at the ``rate``.
    """
    settings = settings or Evaluation()
    distance = passage["distance"].to_numpy()
    fastest = float((np.diff(distance) / np.diff(passage["time"].to_numpy())).max())
    samples = resample(distance, _forces(passage), settings.rate / fastest)
    numbers = _bands_of(samples)
    return xr.Dataset(
        {
            "contact_force_wavelength_band": _variable(
                "band_wavelength", _band_values(samples, numbers)
            )
        },
        coords={
            "band_wavelength": (
                "band_wavelength",
                midband(-numbers),
                labels("m", "exact midband wavelength"),
            ),
            "nominal_wavelength": (
                "band_wavelength",
                nominal(-numbers),
                labels("m", "nominal midband wavelength"),
            ),
            "wheel": passage["wheel"],
        },
        attrs={"wavelength_limit": 1.0 / samples.limit},
    )


def midband(numbers: NDArray[np.int_]) -> NDArray[np.float64]:
    """Return the exact midband frequencies of bands, number 0 being that of 1 Hz."""
    return np.asarray(10.0 ** (numbers / 10.0))


def edges(numbers: NDArray[np.int_]) -> NDArray[np.float64]:
    """Return the lower edges of bands and the upper edge of the last one."""
    return np.append(10.0 ** ((numbers - 0.5) / 10.0), 10.0 ** ((numbers[-1] + 0.5) / 10.0))


def nominal(numbers: NDArray[np.int_]) -> NDArray[np.float64]:
    """Return the midband frequencies as they are called, 31.5 Hz for 31.62 Hz."""
    return np.array([float(f"{NOMINAL[n % 10]}e{n // 10}") for n in numbers.tolist()])


def _forces(passage: xr.Dataset) -> NDArray[np.float64]:
    return passage["contact_force"].transpose("time", "wheel").to_numpy()


def _variable(dim: str, values: NDArray[np.float64]) -> tuple[object, ...]:
    name = "effective value of the contact force in a one-third-octave band"
    return (dim, "wheel"), values, labels("N", name)


def _bands_of(samples: Samples) -> NDArray[np.int_]:
    """Return the numbers of the bands that lie within what a series can show."""
    line = samples.rate / len(samples.x)
    width = 10.0**0.05 - 10.0**-0.05  # over the midband frequency
    first = np.ceil(10.0 * np.log10(LINES_IN_A_BAND * line / width))
    last = np.floor(10.0 * np.log10(samples.limit) - 0.5)
    if last < first:
        raise InputError(
            f"the run shows {line:.3g} to {samples.limit:.3g} oscillations per second or metre, in "
            "which no one-third-octave band fits: evaluate a longer run"
        )
    return np.arange(int(first), int(last) + 1)


def _band_values(samples: Samples, numbers: NDArray[np.int_]) -> NDArray[np.float64]:
    """Integrate the power of all lines between the edges, each spread over its width."""
    frequency, power = signal.periodogram(
        samples.values, fs=samples.rate, scaling="spectrum", detrend="constant", axis=0
    )
    line = samples.rate / len(samples.x)
    ends = np.append(frequency - 0.5 * line, frequency[-1] + 0.5 * line)
    total = np.concatenate((np.zeros_like(power[:1]), np.cumsum(power, axis=0)))
    at_edges = np.stack([np.interp(edges(numbers), ends, column) for column in total.T], axis=-1)
    # rounding may leave less than nothing of an empty band
    return np.sqrt(np.maximum(np.diff(at_edges, axis=0), 0.0))
