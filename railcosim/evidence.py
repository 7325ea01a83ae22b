"""What is kept of a co-simulation that fails: its result so far, and a file that repeats it."""

from __future__ import annotations

from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING

import orchestrator
from orchestrator.replay import write_replay

from .errors import RunError
from .output import replacing

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    import xarray as xr

    from orchestrator import Outcome
    from orchestrator.replay import ReplayCase


@contextmanager
def keeping_evidence(
    case: ReplayCase, path: Path | None, label: Callable[[Outcome], xr.Dataset | None]
) -> Iterator[None]:
    """Keep what there is if the block fails.

    Parameters
    ----------
    case : ReplayCase
        What runs; how it ends is filled in.
    path : Path or None
        Replay file to write then; None for none.
    label : callable
        Makes a result of how far the run came, or None where there is nothing to keep.

    Raises
    ------
    RunError
        With the result so far, if the block raises `orchestrator.RunError`.
    """
    try:
        yield
    except orchestrator.RunError as error:
        message = str(error)
        result = None if error.outcome is None else label(error.outcome)
        if path is not None:
            message += f" {_write(replace(case, error=message, attempt=error.last_attempt), path)}"
        raise RunError(message, result=result) from error


def _write(case: ReplayCase, path: Path) -> str:
    """Write a replay file and say so, or why it was not possible: the run's error comes first."""
    try:
        with replacing(path) as temporary:
            write_replay(temporary, case)
    except RunError as error:
        return f"(There is no replay file: {error}.)"
    return f"(This repeats it: railcosim replay {path})"
