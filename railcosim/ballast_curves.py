"""Load over displacement of the ballast under one rail seat, as labelled arrays and numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from rich.table import Table

from .errors import InputError
from .load_displacement import Polynomial, fit_polynomial, viscous_loss_factor
from .run_record import programs
from .scenario_file import to_toml

if TYPE_CHECKING:
    from track_fmu.beam_element import FloatArray

    from .load_displacement import SecantLaw
    from .scenario import Scenario
    from .track_section import Track

SAMPLES = 201
"""Displacements at which the curves are sampled."""

OWN = {
    True: ("polynomial", "load by the polynomial of the scenario, Eq. (27)"),
    False: ("ballast", "load by the ballast of the scenario"),
}
"""Name and meaning of the scenario's curve, by whether it is a polynomial."""


def ballast_polynomial(track: Track) -> Polynomial | None:
    """Return Eq. (27) with the coefficients of a scenario, without them where it is linear.

    None where the ballast is no polynomial.
    """
    if track.ballast not in {"linear", "state_dependent"}:
        return None
    bent = track.ballast != "linear"
    return Polynomial(
        alpha=track.ballast_alpha * bent,
        beta=track.ballast_beta * bent,
        delta=track.ballast_delta * bent,
        stiffness=track.ballast_stiffness,
    )


def own_load(track: Track, displacement: FloatArray) -> FloatArray:
    """Return the load of a scenario's ballast [N], without factors and gaps.

    Parameters
    ----------
    track : Track
        Its law.
    displacement : (n,) float array
        Of at least 0 [m].

    Raises
    ------
    InputError
        For a table that cannot be used.
    """
    polynomial = ballast_polynomial(track)
    if polynomial is not None:
        return polynomial.force(displacement)
    from .monolithic.curves import ballast_curve  # noqa: PLC0415 - loads scipy.interpolate

    return ballast_curve(track).jet(displacement).load


def compute_curves(scenario: Scenario, law: SecantLaw, loads: FloatArray) -> xr.Dataset:
    """Sample the load-displacement curves from no load to the largest one.

    Parameters
    ----------
    scenario : Scenario
        Its ballast where all supports are alike, and its linear ballast.
    law : SecantLaw
        Measured law, Eq. (26).
    loads : (n,) float array
        Loads of the markers, at which the law is fitted anew; ascending [N].

    Returns
    -------
    xarray.Dataset
        Loads over ``displacement`` and the markers over ``load``. The scenario's own load is
        ``force_polynomial``, or ``force_ballast`` where that is none.

    Raises
    ------
    InputError
        For a table that cannot be used.
    """
    markers = law.displacement(loads)
    displacement = np.linspace(0.0, float(markers[-1]), SAMPLES)
    fitted = fit_polynomial(law, loads)
    name, described = OWN[ballast_polynomial(scenario.track) is not None]

    def force(values: FloatArray, meaning: str) -> tuple[str, FloatArray, dict[str, str]]:
        return "displacement", values, {"units": "N", "long_name": meaning}

    return xr.Dataset(
        {
            "force_law": force(law.force(displacement), "load by the measured law, Eq. (26)"),
            f"force_{name}": force(own_load(scenario.track, displacement), described),
            "force_fitted": force(
                fitted.force(displacement), "load by a polynomial fitted to the law"
            ),
            "force_linear": force(
                scenario.track.ballast_stiffness * displacement, "load on the linear ballast"
            ),
            "load_displacement": (
                "load",
                markers,
                {"units": "m", "long_name": "sleeper displacement by the measured law"},
            ),
        },
        coords={
            "displacement": (
                "displacement",
                displacement,
                {"units": "m", "long_name": "sleeper displacement", "sign": "downwards positive"},
            ),
            "load": ("load", loads, {"units": "N", "long_name": "load on a rail seat"}),
        },
        attrs={
            "Conventions": "CF-1.11",
            "title": "Load over displacement of the ballast under one rail seat",
            "slope": law.slope,
            "stiffness": law.stiffness,
            "scenario": to_toml(scenario),
            **programs(),
        },
    )


def curve_numbers(
    scenario: Scenario, law: SecantLaw, loads: FloatArray, frequency: float
) -> dict[str, Any]:
    """Return the coefficients, how far they are from the law, and the loss factor; SI units.

    The scenario's are under ``polynomial``; where its ballast is none, they are ``null``.

    Parameters
    ----------
    scenario, law, loads
        As `compute_curves` takes them.
    frequency : float
        At which the loss factor is taken [Hz].

    Raises
    ------
    InputError
        For a frequency that is not above zero, or a table that cannot be used.
    """
    if not (np.isfinite(frequency) and frequency > 0.0):
        raise InputError(f"--frequency is {frequency:g} Hz but must be above 0 Hz")
    track = scenario.track
    displacement = law.displacement(loads)

    def described(polynomial: Polynomial | None, load: FloatArray) -> dict[str, float | None]:
        names = ("alpha", "beta", "delta")
        own = {name: None if polynomial is None else getattr(polynomial, name) for name in names}
        return own | {"largest_deviation": float(np.max(np.abs(load - loads)))}

    fitted = fit_polynomial(law, loads)

    return {
        "law": {"slope": law.slope, "stiffness": law.stiffness},
        "largest_load": float(loads[-1]),
        "largest_displacement": float(displacement[-1]),
        "polynomial": described(ballast_polynomial(track), own_load(track, displacement)),
        "fitted": described(fitted, fitted.force(displacement)),
        "loss_factor": viscous_loss_factor(
            frequency=frequency, damping=track.ballast_damping, stiffness=track.ballast_stiffness
        ),
        "loss_factor_frequency": frequency,
    }


def curve_table(numbers: dict[str, Any]) -> Table:
    """Lay the numbers of `curve_numbers` out for the terminal."""
    table = Table(title="Ballast under one rail seat")
    table.add_column("")
    table.add_column("scenario", justify="right")
    table.add_column("fitted to Eq. (26)", justify="right")
    table.add_column("unit")
    both = numbers["polynomial"], numbers["fitted"]
    for name, unit in (("alpha", "N/m2"), ("beta", "N/m3"), ("delta", "N/m4")):
        cells = ("-" if item[name] is None else f"{item[name]:.4g}" for item in both)
        table.add_row(name, *cells, unit)
    load = 1e-3 * numbers["largest_load"]
    table.add_row(
        f"largest deviation from Eq. (26) up to {load:g} kN",
        *(f"{1e-3 * item['largest_deviation']:.2f}" for item in both),
        "kN",
    )
    at = numbers["loss_factor_frequency"]
    table.add_row(f"loss factor at {at:g} Hz", f"{numbers['loss_factor']:.3f}", "", "")
    return table
