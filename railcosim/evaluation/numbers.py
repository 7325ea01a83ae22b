"""An evaluation as plain numbers and as a table for the terminal."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from rich.table import Table

if TYPE_CHECKING:
    from collections.abc import Iterator

    import xarray as xr

LONG = {"time", "record_time", "frequency"}
"""Dimensions that are for files rather than for eyes."""


def plain_numbers(evaluation: xr.Dataset, *, complete: bool) -> dict[str, Any]:
    """Return the variables as nested lists, with None for what there is no value of.

    Parameters
    ----------
    evaluation : xarray.Dataset
        From `parts.evaluate`.
    complete : bool
        Whether histories and spectra are wanted too.
    """
    return {
        str(name): _plain(variable.to_numpy().tolist())
        for name, variable in evaluation.variables.items()
        if complete or not LONG & set(map(str, variable.dims))
    }


def evaluation_table(evaluation: xr.Dataset, title: str) -> Table:
    """Lay out what there is of the numbers of wheels, gauges and supports, with usual units."""
    table = Table(title=title, show_header=False)
    table.add_column("what")
    table.add_column("value", justify="right")
    table.add_column("unit")
    for rows in (_wheel_rows, _spectrum_rows, _bay_rows, _gauge_rows, _support_rows):
        for row in rows(evaluation):
            table.add_row(*row)
        table.add_section()
    return table


def _plain(values: object) -> object:
    if isinstance(values, list):
        return [_plain(value) for value in values]
    return None if isinstance(values, float) and math.isnan(values) else values


def _wheel_rows(evaluation: xr.Dataset) -> Iterator[tuple[str, str, str]]:
    if "dynamic_factor" not in evaluation:
        return
    for wheel in evaluation["wheel"].to_numpy():
        one = evaluation.sel(wheel=wheel)
        yield f"wheel {wheel}: contact force", _range(one, "contact_force", 1e-3), "kN"
        yield "  dynamic factor", f"{float(one['dynamic_factor']):.2f}", ""
        yield "  time without contact", f"{1e3 * float(one['loss_of_contact_time']):.2f}", "ms"


def _spectrum_rows(evaluation: xr.Dataset) -> Iterator[tuple[str, str, str]]:
    for name, along, names, what in (
        ("contact_force_amplitude", "frequency", "frequency", "line of the spectrum, {:g} Hz"),
        ("contact_force_band", "band_frequency", "nominal_frequency", "third octave, {:g} Hz"),
        (
            "contact_force_wavelength_band",
            "band_wavelength",
            "nominal_wavelength",
            "third octave, wavelength {:g} m",
        ),
    ):
        if name not in evaluation:
            continue
        for wheel in evaluation["wheel"].to_numpy():
            values = evaluation[name].sel(wheel=wheel)
            place = float(evaluation[names].sel({along: values.idxmax(along)}))
            where = f"wheel {wheel}: largest {what.format(place)}"
            yield where, f"{1e-3 * float(values.max()):.2f}", "kN"


def _bay_rows(evaluation: xr.Dataset) -> Iterator[tuple[str, str, str]]:
    if "bay_max_force" not in evaluation:
        return
    for wheel in evaluation["wheel"].to_numpy():
        read = evaluation["bay_max_force"].sel(wheel=wheel).dropna("bay")
        if read.size:
            where = f"wheel {wheel}: load detector, largest in bay {int(read.idxmax('bay'))}"
            yield where, f"{1e-3 * float(read.max()):.1f}", "kN"


def _gauge_rows(evaluation: xr.Dataset) -> Iterator[tuple[str, str, str]]:
    if "max_strain" not in evaluation:
        return
    for gauge in evaluation["gauge"].to_numpy():
        one = evaluation.sel(gauge=gauge)
        where = f"gauge {gauge} at {float(one['gauge_position']):.3f} m: bending moment"
        yield where, _range(one, "bending_moment", 1e-3), "kN m"
        yield "  strain", _range(one, "strain", 1e6), "10^-6"


def _support_rows(evaluation: xr.Dataset) -> Iterator[tuple[str, str, str]]:
    if "max_pad_force" not in evaluation:
        return
    for name, what in (("max_pad_force", "pad"), ("max_ballast_force", "ballast")):
        force = evaluation[name]
        sleeper = int(force.idxmax("sleeper"))
        where = f"largest force in the {what}, under rail seat {sleeper}"
        yield where, f"{1e-3 * float(force.max()):.1f}", "kN"


def _range(numbers: xr.Dataset, name: str, factor: float) -> str:
    ends = (factor * float(numbers[f"{kind}_{name}"]) for kind in ("min", "max"))
    return " to ".join(f"{end:.1f}" for end in ends)
