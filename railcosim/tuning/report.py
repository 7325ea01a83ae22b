"""The numbers of a fit, for programs and for the terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from rich.table import Table

from ..receptance.measured import DECIBEL

if TYPE_CHECKING:
    from collections.abc import Iterable

    from ..sections import Track
    from .ballast import TunedBallast
    from .estimate import Estimate
    from .receptance import TunedTrack


def receptance_fit_numbers(tuned: TunedTrack, start: Track) -> dict[str, Any]:
    """Return what was fitted to a receptance from which start; SI units, deviations in dB, deg."""
    phase = tuned.phase_deviation
    return {
        "parameters": _parameters(tuned.estimates, start),
        "points": tuned.points,
        "amplitude_deviation": DECIBEL * tuned.amplitude_deviation,
        "phase_deviation": None if phase is None else float(np.rad2deg(phase)),
    }


def ballast_fit_numbers(tuned: TunedBallast, start: Track) -> dict[str, Any]:
    """Return what was fitted to secant stiffness; SI units."""
    return {
        "parameters": _parameters(tuned.estimates, start),
        "points": tuned.points,
        "slope": tuned.slope.numbers(),
        "stiffness": tuned.law.stiffness,
        "scatter": tuned.scatter,
        "largest_load": tuned.largest_load,
        "polynomial_deviation": tuned.polynomial_deviation,
    }


def fit_table(numbers: dict[str, Any], rows: Iterable[tuple[str, str]], title: str) -> Table:
    """Lay fitted parameters out, and below them what else there is to say.

    Parameters
    ----------
    numbers : dict
        As `receptance_fit_numbers` or `ballast_fit_numbers` return them.
    rows : iterable of (str, str)
        What else, as name and value.
    title : str
        What was fitted to what.
    """
    table = Table(title=title)
    table.add_column("")
    for heading in ("start", "fitted", "from", "to"):
        table.add_column(heading, justify="right")
    table.add_column("unit")
    for name, item in numbers["parameters"].items():
        values = (f"{item[key]:.4g}" for key in ("start", "value", "low", "high"))
        table.add_row(name, *values, item["unit"])
    table.add_section()
    for name, value in rows:
        table.add_row(name, "", value)
    return table


def receptance_rows(numbers: dict[str, Any]) -> list[tuple[str, str]]:
    """Say how good a fit to a receptance is."""
    rows = [
        ("measured frequencies", f"{numbers['points']}"),
        ("amplitude, r.m.s. [dB]", f"{numbers['amplitude_deviation']:.2f}"),
    ]
    if numbers["phase_deviation"] is not None:
        rows.append(("phase, r.m.s. [deg]", f"{numbers['phase_deviation']:.1f}"))
    return rows


def ballast_rows(numbers: dict[str, Any]) -> list[tuple[str, str]]:
    """Say what a fit to secant stiffness went through."""
    slope = numbers["slope"]
    return [
        ("measured points", f"{numbers['points']}"),
        ("slope [1/m]", f"{slope['value']:.4g} ({slope['low']:.4g} to {slope['high']:.4g})"),
        ("scatter, r.m.s. [MN/m]", f"{1e-6 * numbers['scatter']:.2f}"),
        ("polynomial from line [kN]", f"{1e-3 * numbers['polynomial_deviation']:.2f}"),
    ]


def _parameters(estimates: Iterable[Estimate], start: Track) -> dict[str, Any]:
    return {item.name: {"start": getattr(start, item.name), **item.numbers()} for item in estimates}
