"""The numbers of a case: those of the summary that do not differ from run to run."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..strike import PASSAGE_NUMBERS
from ..summary import CAUSES, summarise

if TYPE_CHECKING:
    import xarray as xr

NUMBERS: dict[str, tuple[str, str, str]] = {
    **PASSAGE_NUMBERS,
    "simulated_time": ("s", "simulated time", "none"),
    "steps_accepted": ("1", "accepted steps", "none"),
    **{
        f"steps_rejected_{cause}": ("1", f"attempts rejected because of {cause}", "none")
        for cause in CAUSES
    },
    "iterations": ("1", "coupling iterations of all attempts", "none"),
}
"""Units, long name and sign of every number."""


def numbers_of(passage: xr.Dataset) -> dict[str, float]:
    """Compute the `NUMBERS` of a complete passage.

    Raises
    ------
    ValueError
        Where the passage has not reached the flat.
    """
    summary = summarise(passage)
    steps = summary.steps
    rejected = {f"steps_rejected_{cause}": number for cause, number in steps.rejected.items()}
    known = {
        **{name: getattr(summary, name) for name in NUMBERS if hasattr(summary, name)},
        **rejected,
        "steps_accepted": steps.accepted,
        "iterations": steps.iterations,
    }
    missing = [name for name in NUMBERS if known[name] is None]
    if missing:
        raise ValueError(f"the passage ends before there is a {missing[0]}")
    return {name: float(known[name]) for name in NUMBERS}
