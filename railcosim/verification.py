"""A co-simulated passage against the same one solved as one system of equations."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from .scenario_file import from_toml
from .signals import COMPRESSION
from .summary import summarise

if TYPE_CHECKING:
    from .scenario import Scenario

FORCE_LIMIT = 0.01
"""Largest difference of contact forces at any time, over the static load."""

PEAK_LIMIT = 0.003
"""Largest relative difference of the peak contact forces."""

SUSPENSION_LIMIT = 0.01
"""Largest difference of suspension forces at any time, over their largest change in the run."""

FINE_STEP = 2e-5
"""Macro steps whose error is far below the limits [s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Agreement:
    """One quantity of both solutions.

    Attributes
    ----------
    quantity : str
        What is compared.
    cosimulation, monolith : float
        Its values where they differ most [N].
    difference, limit : float
        Theirs, over the static load or, of the peaks, over the monolith's; signed, and its bound.
    relative_to : str
        What the difference is divided by.
    time : float
        When they differ most, or of the monolith's peak [s].
    distance : float
        Where the wheel is then, from the flat's centre [m].
    """

    quantity: str
    cosimulation: float
    monolith: float
    difference: float
    limit: float
    relative_to: str
    time: float
    distance: float

    @property
    def holds(self) -> bool:
        """Whether the difference is within the limit; not where it is no number."""
        return abs(self.difference) <= self.limit

    def describe(self) -> str:
        """Say what was found, where and when."""
        return (
            f"{100.0 * self.difference:+.3f} % of the {self.relative_to}, at most "
            f"{100.0 * self.limit:g} %; {1e-3 * self.cosimulation:.2f} kN and "
            f"{1e-3 * self.monolith:.2f} kN at t = {self.time:.6f} s, "
            f"{self.distance:+.4f} m from the flat's centre"
        )

    def as_dict(self) -> dict[str, Any]:
        """Return the values and the verdict, as ``--json`` prints them."""
        return asdict(self) | {"holds": self.holds}


def side_by_side(cosimulation: xr.Dataset, monolith: xr.Dataset) -> xr.Dataset:
    """Put the contact forces of both solutions, at the same times, into one dataset.

    Parameters
    ----------
    cosimulation, monolith : xarray.Dataset
        Results of the same scenario, the second one at the times of the first.

    Returns
    -------
    xarray.Dataset
        The forces [N] and their difference over the static load; the first solution's attributes.
    """
    force = cosimulation["contact_force"]
    forces = {
        "cosimulation": force,
        "monolith": force.copy(data=monolith["contact_force"].to_numpy()),
    }
    load = float(cosimulation["static_wheel_load"])
    columns = {
        f"contact_force_{name}": values.assign_attrs(
            long_name=f"wheel-rail contact force of the {name}"
        )
        for name, values in forces.items()
    }
    difference = (forces["cosimulation"] - forces["monolith"]) / load
    columns["difference"] = difference.assign_attrs(
        units="1",
        long_name="contact force of the co-simulation less that of the monolith, over the static "
        "load",
        sign=COMPRESSION,
    )
    kept = ("flat_wheel", "flat_position", "static_wheel_load")
    return xr.Dataset(
        columns | {name: cosimulation[name] for name in kept},
        attrs={name: cosimulation.attrs[name] for name in ("Conventions", "source", "versions")}
        | {
            "title": "Contact forces of a co-simulation and of the same passage as one system",
            "scenario": cosimulation.attrs["scenario"],
            "model": monolith.attrs["model"],
            "contact_form": monolith.attrs["contact_form"],
        },
    )


def agreements(cosimulation: xr.Dataset, monolith: xr.Dataset) -> list[Agreement]:
    """Compare two solutions.

    Parameters
    ----------
    cosimulation, monolith : xarray.Dataset
        Results of the same scenario, the second one at the times of the first.

    Returns
    -------
    list of Agreement
        The force of every wheel at all times; those of both suspensions, if there are any; the
        peak force of the flat's wheel, where the run reaches the flat.
    """
    scenario = from_toml(cosimulation.attrs["scenario"])
    both = side_by_side(cosimulation, monolith)
    found = [
        _worst(both, cosimulation, scenario, wheel) for wheel in cosimulation["wheel"].to_numpy()
    ]
    found += [
        _worst_suspension(cosimulation, monolith, stage)
        for stage in ("primary", "secondary")
        if f"{stage}_force" in cosimulation
    ]
    peaks = summarise(cosimulation), summarise(monolith)
    ours, theirs = (peak.peak_contact_force for peak in peaks)
    place = peaks[1].peak_contact_force_position
    if ours is not None and theirs is not None and place is not None:
        time = float(np.interp(place, monolith["distance"], monolith["time"]))
        found.append(
            Agreement(
                quantity="peak contact force of the flat's wheel",
                cosimulation=ours,
                monolith=theirs,
                difference=ours / theirs - 1.0,
                limit=PEAK_LIMIT,
                relative_to="peak",
                time=time,
                distance=place,
            )
        )
    return found


def advice(cosimulation: xr.Dataset) -> str:
    """Say how to find out which of two solutions that differ is to blame."""
    master = from_toml(cosimulation.attrs["scenario"]).master
    if master.step is not None and master.step <= FINE_STEP:
        return "the steps are short enough, so look at track.mode_pairs and supports_per_wheel"
    return (
        f"repeat with --set master.step={FINE_STEP:g}: what then remains is no error of the "
        "master's steps but of the track's modes"
    )


def _worst(both: xr.Dataset, passage: xr.Dataset, scenario: Scenario, wheel: int) -> Agreement:
    """Where the forces of a wheel differ most."""
    own = both.sel(wheel=wheel)
    place = int(np.abs(own["difference"].to_numpy()).argmax())
    here = own.isel(time=place)
    position = float(passage["wheel_position"].sel(wheel=wheel).isel(time=place))
    return Agreement(
        quantity=f"contact force of wheel {wheel}",
        cosimulation=float(here["contact_force_cosimulation"]),
        monolith=float(here["contact_force_monolith"]),
        difference=float(here["difference"]),
        limit=FORCE_LIMIT,
        relative_to="static load",
        time=float(here["time"]),
        distance=position - scenario.flat_position,
    )


def _worst_suspension(cosimulation: xr.Dataset, monolith: xr.Dataset, stage: str) -> Agreement:
    """Where the forces of a suspension differ most, whichever wheel or bogie that is at."""
    ours, theirs = (passage[f"{stage}_force"].to_numpy() for passage in (cosimulation, monolith))
    difference = ours - theirs
    time, which = np.unravel_index(np.abs(difference).argmax(), difference.shape)
    change = float(np.abs(theirs - theirs[0]).max()) or float(np.abs(theirs[0]).max())
    return Agreement(
        quantity=f"{stage} suspension",
        cosimulation=float(ours[time, which]),
        monolith=float(theirs[time, which]),
        difference=float(difference[time, which]) / change,
        limit=SUSPENSION_LIMIT,
        relative_to="largest change of its forces",
        time=float(cosimulation["time"][time]),
        distance=float(cosimulation["distance"][time]),
    )
