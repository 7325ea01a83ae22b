"""The numbers of a fit, for programs and for the terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from rich.table import Table
from rich.text import Text

from ..receptance.measured import DECIBEL

if TYPE_CHECKING:
    from collections.abc import Iterable

    from ..track_section import Track
    from .ballast import TunedBallast
    from .estimate import Estimate
    from .receptance import TunedTrack

SHOWN_AS = {"N/m": (1e-6, "MN/m"), "N s/m": (1e-3, "kN s/m")}
"""Units in which engineers read what is kept in SI units."""


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


def fit_table(numbers: dict[str, Any], rows: Iterable[tuple[str, str, str]], title: str) -> Table:
    """Lay fitted parameters out, and below them what else there is to say.

    Parameters
    ----------
    numbers : dict
        As `receptance_fit_numbers` or `ballast_fit_numbers` return them.
    rows : iterable of (str, str, str)
        What else, as name, value and unit.
    title : str
        What was fitted to what.
    """
    table = Table(title=Text(title))  # the name of a file is no markup
    table.add_column("")
    for heading in ("start", "fitted", "from", "to"):
        table.add_column(heading, justify="right")
    table.add_column("unit")
    for name, item in numbers["parameters"].items():
        factor, unit = SHOWN_AS.get(item["unit"], (1.0, item["unit"]))
        values = (f"{factor * item[key]:.4g}" for key in ("start", "value", "low", "high"))
        table.add_row(name, *values, unit)
    table.add_section()
    for name, value, unit in rows:
        table.add_row(name, "", value, "", "", unit)
    return table


def receptance_rows(numbers: dict[str, Any]) -> list[tuple[str, str, str]]:
    """Say how good a fit to a receptance is."""
    rows = [
        ("measured frequencies", f"{numbers['points']}", ""),
        ("amplitude, r.m.s.", f"{numbers['amplitude_deviation']:.2f}", "dB"),
    ]
    if numbers["phase_deviation"] is not None:
        rows.append(("phase, r.m.s.", f"{numbers['phase_deviation']:.1f}", "deg"))
    return rows


def ballast_rows(numbers: dict[str, Any]) -> list[tuple[str, str, str]]:
    """Say what a fit to secant stiffness went through."""
    return [
        ("measured points", f"{numbers['points']}", ""),
        ("slope of the line", f"{numbers['slope']['value']:.4g}", "1/m"),
        ("scatter, r.m.s.", f"{1e-6 * numbers['scatter']:.2f}", "MN/m"),
        ("polynomial from line", f"{1e-3 * numbers['polynomial_deviation']:.2f}", "kN"),
    ]


def _parameters(estimates: Iterable[Estimate], start: Track) -> dict[str, Any]:
    return {item.name: {"start": getattr(start, item.name), **item.numbers()} for item in estimates}
