"""The numbers of one passage."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from .contact_loss import contact_losses

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

WINDOW = (-0.1, 0.8)
"""Part of the run that most numbers look at: the flat's wheel from the flat's centre [m]."""

CAUSES = ("error", "event", "convergence", "discard", "invalid")
"""Why the master rejects an attempt."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Steps:
    """What the master did.

    Attributes
    ----------
    accepted : int
        Accepted steps.
    rejected : dict of str to int
        Rejected attempts by cause.
    iterations : int
        Coupling iterations of all attempts.
    """

    accepted: int
    rejected: dict[str, int]
    iterations: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Summary:
    """The numbers of one passage, SI units.

    Those that look at the flat's wheel look at it in `WINDOW`; they are None where an interrupted
    run has not reached it.

    Attributes
    ----------
    peak_contact_force, min_contact_force : float or None
        Of the flat's wheel [N].
    peak_contact_force_position : float or None
        Where the peak occurs, from the flat's centre [m].
    loss_of_contact_time : float or None
        Time without contact [s].
    max_sleeper_displacement : float
        Of all sleepers over the whole run [m], downwards.
    peak_bending_moment_midspan : float or None
        In the middle of the struck bay [N m], sagging positive.
    peak_bending_moment_under_wheel : float or None
        Under the flat's wheel [N m], sagging positive.
    steps : Steps
        What the master did.
    simulated_time, wall_time : float
        Time that passed in the simulation and on the clock [s].
    warnings, unreliable : list of str
        What makes the result doubtful, and what makes it wrong, a sentence each.
    """

    peak_contact_force: float | None
    peak_contact_force_position: float | None
    min_contact_force: float | None
    loss_of_contact_time: float | None
    max_sleeper_displacement: float
    peak_bending_moment_midspan: float | None
    peak_bending_moment_under_wheel: float | None
    steps: Steps
    simulated_time: float
    wall_time: float
    warnings: list[str]
    unreliable: list[str]

    def as_dict(self) -> dict[str, Any]:
        """Return the numbers as a nested dict, as ``--json`` prints them."""
        return asdict(self)


def summarise(passage: xr.Dataset) -> Summary:
    """Compute the numbers of a passage.

    Parameters
    ----------
    passage : xarray.Dataset
        Result of a passage, also read back from a file.

    Returns
    -------
    Summary
        All its numbers.
    """
    wheel = passage.sel(wheel=passage["flat_wheel"])
    points = _window_points(passage["distance"].to_numpy())

    def cut(variable: xr.DataArray) -> NDArray[np.float64]:
        return np.interp(points, passage["distance"], variable)

    force, losses = (
        cut(wheel["contact_force"]),
        contact_losses(cut(passage["time"]), cut(wheel["gap"])),
    )
    reached = points.size > 0
    return Summary(
        peak_contact_force=float(force.max()) if reached else None,
        peak_contact_force_position=float(points[force.argmax()]) if reached else None,
        min_contact_force=float(force.min()) if reached else None,
        loss_of_contact_time=sum((end - start for start, end in losses), 0.0) if reached else None,
        max_sleeper_displacement=float(passage["sleeper_displacement"].max()),
        peak_bending_moment_midspan=_largest(cut(passage["bending_moment"].isel(gauge=0))),
        peak_bending_moment_under_wheel=_largest(cut(wheel["bending_moment_under_wheel"])),
        steps=steps_of(passage),
        simulated_time=float(passage.attrs["simulated_time"]),
        wall_time=float(passage.attrs["wall_time"]),
        warnings=passage.attrs["warnings"].splitlines(),
        unreliable=passage.attrs["unreliable"].splitlines(),
    )


def steps_of(result: xr.Dataset) -> Steps:
    """Return what the master did, from the attributes of a result."""
    return Steps(
        accepted=int(result.attrs["steps_accepted"]),
        rejected={cause: int(result.attrs[f"steps_rejected_{cause}"]) for cause in CAUSES},
        iterations=int(result.attrs["iterations"]),
    )


def _window_points(distance: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the distances inside `WINDOW` and its ends, none where the run has not reached it."""
    start, end = max(WINDOW[0], distance[0]), min(WINDOW[1], distance[-1])
    if end < start:
        return np.empty(0)
    inside = distance[(distance > start) & (distance < end)]
    return np.unique(np.concatenate(([start], inside, [end])))


def _largest(values: NDArray[np.float64]) -> float | None:
    return float(values.max()) if values.size else None
