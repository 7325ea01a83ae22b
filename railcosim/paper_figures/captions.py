"""What is said under the figures: what was calculated, and what was not measured."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..figures.passage import describe_flat
from ..figures.speed import FEWEST_SPEEDS
from .passages import BALLASTS

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray as xr

    from ..scenario import Scenario

SOURCE = "Nielsen & Oscarsson (2004), Journal of Sound and Vibration"
"""The study that the figures repeat."""


def receptance_caption(scenario: Scenario, receptance: xr.Dataset, measured: str | None) -> str:
    """Say what the receptance is of, and where its resonances are."""
    peaks = ", ".join(f"{peak:.0f}" for peak in receptance["peak_frequency"].to_numpy())
    place = scenario.gauge_positions[0]
    return (
        f"Direct receptance of the unloaded track at midspan (x = {place:g} m), from the full "
        f"matrices and from the modes; resonances at {peaks} Hz. {_measured(measured)} After "
        f"Fig. 6 of {SOURCE}."
    )


def ballast_caption(curves: xr.Dataset, measured: str | None) -> str:
    """Say which curves of the ballast are drawn."""
    stiffness, slope = curves.attrs["stiffness"], curves.attrs["slope"]
    return (
        f"Load on the ballast under a rail seat over the displacement of the sleeper: the secant "
        f"stiffness that rises by {slope:g} N/m per N from {1e-6 * stiffness:g} MN/m, Eq. (26); "
        "the polynomial of the scenario, Eq. (27); one fitted anew; the linear ballast. "
        f"{_measured(measured)} After Fig. 7 of {SOURCE}."
    )


def peak_caption(
    scenario: Scenario, peaks: xr.Dataset, name: str, what: str, measured: str | None
) -> str:
    """Say what peaks over speed are of, and at which speeds they are largest."""
    largest = " and ".join(
        f"at {float(peaks[name].sel(ballast=ballast).idxmax('speed_kmh')):g} km/h on the "
        f"{ballast.replace('_', '-')} track"
        for ballast in BALLASTS
    )
    fits = (
        "Lines: polynomials of fifth order fitted to the points."
        if peaks.sizes["speed_kmh"] >= FEWEST_SPEEDS
        else f"No polynomials of fifth order: these take at least {FEWEST_SPEEDS} speeds."
    )
    return (
        f"{what} over the speed, largest {largest}. {fits} {_vehicle(scenario)} "
        f"{_measured(measured)}"
    )


def histories_caption(scenario: Scenario, speed_kmh: float) -> str:
    """Say what the histories are of."""
    return (
        f"Contact force of the flat's wheel, displacement of the sleeper that moves most and "
        f"bending moment of the rail in the middle of the struck bay at {speed_kmh:g} km/h on the "
        f"state-dependent and the linear track. {_vehicle(scenario)} {_measured(None)}"
    )


def captions_text(captions: Sequence[tuple[str, str]]) -> str:
    """Put figures' names and captions together as Markdown."""
    blocks = [f"## {name}\n\n![{name}]({name}.png)\n\n{caption}\n" for name, caption in captions]
    return "\n".join(["# Figures\n", *blocks])


def _vehicle(scenario: Scenario) -> str:
    """Say which vehicle rolls over which flat."""
    vehicle, flat = scenario.vehicle, scenario.flat
    wheel = "wheels" if vehicle.wheels > 1 else "wheel"
    strike = (
        "round wheels"
        if flat.shape == "none"
        else f"a {describe_flat(flat)} flat on wheel {flat.wheel}, whose centre meets the rail at "
        f"x = {scenario.flat_position:g} m"
    )
    return (
        f"{vehicle.wheels} {wheel} of {vehicle.wheel_mass:g} kg each under a static load of "
        f"{1e-3 * vehicle.static_wheel_load:.2f} kN, with {strike}."
    )


def _measured(name: str | None) -> str:
    """Say whose measured points are drawn: those of the paper are not published as numbers."""
    if name is None:
        return (
            "No measured points are drawn: the paper gives none as numbers, nor its flat's shape."
        )
    return f"Measured points: {name}."
