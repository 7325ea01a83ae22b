"""What every result says about the run that made it."""

from __future__ import annotations

import json
from dataclasses import asdict
from importlib.metadata import version
from platform import python_version
from typing import TYPE_CHECKING

import numpy as np

from orchestrator import Cause, IsolatedParticipant

from . import __version__

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from orchestrator import Outcome, System

LIBRARIES = ("numpy", "scipy", "fmpy", "pythonfmu", "xarray")
"""Libraries whose versions a result names."""

ATTEMPT_COLUMNS = {
    "time": ("s", "start of the attempt"),
    "step_size": ("s", "size of the attempted step"),
    "cause": ("1", "accepted, or why the attempt was rejected"),
    "iterations": ("1", "how often the FMUs were stepped"),
    "error_norm": ("1", "difference of prediction and result over the tolerance"),
    "residual_norm": ("1", "what is left of the coupling equations, over the nominal values"),
}
"""Columns of the step log with their units and meaning."""


def attempts(outcome: Outcome) -> dict[str, NDArray[np.generic]]:
    """Return the columns `ATTEMPT_COLUMNS` of the step log, causes as texts."""
    log = outcome.step_log
    names = np.array(["accepted", *(cause.name.lower() for cause in Cause)])
    return {name: log[name] for name in log.dtype.names or ()} | {"cause": names[log["cause"]]}


def programs() -> dict[str, str]:
    """Say which programs made a result."""
    libraries = ", ".join(f"{name} {version(name)}" for name in LIBRARIES)
    return {
        "source": f"railcosim {__version__}",
        "versions": f"Python {python_version()}, {libraries}",
    }


def doubts(outcome: Outcome, system: System) -> list[str]:
    """What makes a result doubtful: warnings of the master, crashes of FMUs that were survived."""
    incidents = [
        incident
        for participant in system.participants
        if isinstance(participant, IsolatedParticipant)
        for incident in participant.incidents
    ]
    return [*outcome.warnings, *incidents]


def _bonds(outcome: Outcome) -> list[dict[str, str | float]]:
    return [asdict(bond) | {"relative": bond.relative} for bond in outcome.bonds]


def statistics(outcome: Outcome) -> dict[str, str | int | float]:
    """Say how the run went."""
    counts = outcome.statistics
    return {
        "complete": int(outcome.finished),
        "stop_reason": outcome.failure or outcome.reason.value,
        "simulated_time": outcome.end_time,
        "wall_time": outcome.wall_time,
        "iterations": counts.iterations,
        "switches": counts.switches,
        "steps_accepted": counts.accepted,
        "warnings": "\n".join(outcome.warnings),
        "unreliable": "\n".join(outcome.unreliable),
        **({} if outcome.audit is None else {"audit": json.dumps(asdict(outcome.audit))}),
        **({"bonds": json.dumps(_bonds(outcome))} if outcome.bonds else {}),
        **{f"steps_rejected_{cause}": number for cause, number in counts.rejected.items()},
    }
