"""The largest and smallest values of a series, with what they mean."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray as xr


def largest(series: xr.DataArray) -> xr.DataArray:
    """Return the largest value over time; it is called so and keeps unit and sign."""
    return _named("largest", series, series.max("time"))


def smallest(series: xr.DataArray) -> xr.DataArray:
    """Return the smallest value over time; it is called so and keeps unit and sign."""
    return _named("smallest", series, series.min("time"))


def _named(word: str, series: xr.DataArray, values: xr.DataArray) -> xr.DataArray:
    attributes = series.attrs | {"long_name": f"{word} {series.attrs['long_name']}"}
    return values.assign_attrs(attributes)
