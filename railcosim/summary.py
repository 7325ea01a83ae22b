"""The numbers of one passage."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from .strike import PASSAGE_NUMBERS, strike_numbers

if TYPE_CHECKING:
    import xarray as xr

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
class WholeRun:
    """Extremes of all wheels over the whole run, every step of it, where ``[keep]`` thins it.

    Attributes
    ----------
    largest_contact_force, smallest_contact_force : float
        Of any wheel [N].
    largest_contact_force_stretch : float
        Where the stretch begins in which the largest one is, from the flat's centre [m].
    time_without_contact : float
        Of the wheel that has most of it [s].
    """

    largest_contact_force: float
    largest_contact_force_stretch: float
    smallest_contact_force: float
    time_without_contact: float


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
    whole_run : WholeRun or None
        None where the result has every history.
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
    whole_run: WholeRun | None = None

    def as_dict(self) -> dict[str, Any]:
        """Return the numbers as a nested dict, as ``--json`` prints them."""
        numbers = asdict(self)
        if self.whole_run is None:
            del numbers["whole_run"]
        return numbers


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
    thinned = is_thinned(passage)
    numbers = _kept_numbers(passage) if thinned else _worked_out(passage)
    return Summary(
        peak_contact_force=numbers.get("peak_contact_force"),
        peak_contact_force_position=numbers.get("peak_contact_force_position"),
        min_contact_force=numbers.get("min_contact_force"),
        loss_of_contact_time=numbers.get("loss_of_contact_time"),
        max_sleeper_displacement=numbers["max_sleeper_displacement"],
        peak_bending_moment_midspan=numbers.get("peak_bending_moment_midspan"),
        peak_bending_moment_under_wheel=numbers.get("peak_bending_moment_under_wheel"),
        whole_run=_whole_run(passage) if thinned else None,
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


def is_thinned(passage: xr.Dataset) -> bool:
    """Tell whether a result has but the histories that ``[keep]`` names."""
    return "kept_signals" in passage.attrs


def _worked_out(passage: xr.Dataset) -> dict[str, float]:
    deepest = float(passage["sleeper_displacement"].max())
    return strike_numbers(passage) | {"max_sleeper_displacement": deepest}


def _kept_numbers(passage: xr.Dataset) -> dict[str, float]:
    return {name: float(passage[name]) for name in PASSAGE_NUMBERS if name in passage}


def _whole_run(passage: xr.Dataset) -> WholeRun:
    largest = passage["contact_force_largest"].max("wheel")
    return WholeRun(
        largest_contact_force=float(largest.max()),
        largest_contact_force_stretch=float(largest.idxmax()),
        smallest_contact_force=float(passage["contact_force_smallest"].min()),
        time_without_contact=float(passage["time_without_contact"].sum("stretch").max()),
    )
