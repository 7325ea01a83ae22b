"""Whether a result is all that was asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .errors import RunError

if TYPE_CHECKING:
    import xarray as xr


def check_result(result: xr.Dataset) -> None:
    """Say why a run ended early or is wrong, if it did or is.

    Parameters
    ----------
    result : xarray.Dataset
        Result of a passage or of another co-simulation.

    Raises
    ------
    RunError
        For a result that is incomplete or wrong.
    """
    if not result.attrs["complete"]:
        raise RunError(
            f"the run ended at t = {result.attrs['simulated_time']:.6g} s, because "
            f"{result.attrs['stop_reason']}; the result reaches up to there"
        )
    if result.attrs["unreliable"]:
        raise RunError(f"the result is wrong: {result.attrs['unreliable'].splitlines()[0]}")
