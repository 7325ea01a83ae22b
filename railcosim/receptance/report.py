"""The numbers of a receptance, for programs and for the terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from rich.table import Table

from .measured import DECIBEL, log_residual

if TYPE_CHECKING:
    import xarray as xr

    from .measured import MeasuredReceptance
    from .study import ReceptanceStudy


def receptance_numbers(
    receptance: xr.Dataset, deviation: dict[str, float | None] | None
) -> dict[str, Any]:
    """Return what a receptance comes to, in SI units.

    Parameters
    ----------
    receptance : xarray.Dataset
        As `compute_receptance` returns it.
    deviation : dict, optional
        Of the measured receptance, as `measured_deviation` returns it.
    """
    attributes = receptance.attrs
    peaks = zip(
        receptance["peak_frequency"].to_numpy(),
        receptance["peak_amplitude"].to_numpy(),
        strict=True,
    )
    methods = [str(name) for name in receptance["solution"].to_numpy()]
    return {
        "load": attributes["load"],
        "response": attributes["response"],
        "preload": attributes["preload"],
        "static_flexibility": float(receptance["static_flexibility"][0]),
        "peaks": [{"frequency": float(f), "amplitude": float(a)} for f, a in peaks],
        "methods": methods,
        "modal_deviation": modal_deviation(receptance),
        "measured": deviation,
    }


def modal_deviation(receptance: xr.Dataset) -> dict[str, float] | None:
    """Largest difference of the modal from the direct receptance, over the direct one, and where.

    None where only one of them is there.
    """
    if receptance.sizes["solution"] == 1:
        return None
    values = receptance["amplitude"] * np.exp(1j * np.deg2rad(receptance["phase"]))
    direct, modal = (values.sel(solution=name).to_numpy() for name in ("direct", "modal"))
    relative = np.abs(modal / direct - 1.0)
    worst = int(np.argmax(relative))
    return {"largest": float(relative[worst]), "frequency": float(receptance["frequency"][worst])}


def measured_deviation(
    study: ReceptanceStudy, measured: MeasuredReceptance
) -> dict[str, float | None]:
    """Root mean squares of the difference of calculated and measured receptance.

    Returns
    -------
    dict
        ``amplitude`` [dB] and ``phase`` [deg], which is None where no phase was measured.
    """
    residual = log_residual(study.receptance(measured.frequency), measured)
    count = len(measured.frequency)
    amplitude, phase = residual[:count], residual[count:]
    return {
        "amplitude": DECIBEL * float(np.sqrt(np.mean(amplitude**2))),
        "phase": float(np.rad2deg(np.sqrt(np.mean(phase**2)))) if phase.size else None,
    }


def receptance_table(numbers: dict[str, Any]) -> Table:
    """Lay the numbers out with the units an engineer expects.

    Parameters
    ----------
    numbers : dict
        As `receptance_numbers` returns them.
    """
    preload = f", preload {1e-3 * numbers['preload']:g} kN" if numbers["preload"] else ""
    table = Table(
        title=f"Force: {numbers['load']}, displacement: {numbers['response']}{preload}",
        show_header=False,
    )
    table.add_column("what")
    table.add_column("value", justify="right")
    table.add_column("unit")
    table.add_row("static flexibility", f"{1e9 * numbers['static_flexibility']:.3f}", "nm/N")
    for peak in numbers["peaks"]:
        at = f"resonance at {peak['frequency']:.1f} Hz"
        table.add_row(at, f"{1e9 * peak['amplitude']:.3f}", "nm/N")
    if worst := numbers["modal_deviation"]:
        what = f"modal from direct, at most, at {worst['frequency']:.0f} Hz"
        table.add_row(what, f"{100.0 * worst['largest']:.3g}", "%")
    if measured := numbers["measured"]:
        table.add_row("calculated from measured, r.m.s.", f"{measured['amplitude']:.2f}", "dB")
        if measured["phase"] is not None:
            table.add_row("", f"{measured['phase']:.1f}", "deg")
    return table
