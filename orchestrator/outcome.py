"""What a run tells about itself when it is over."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from .audit_report import AuditReport
from .bond_report import BondReport


class StopReason(Enum):
    """Why the run ended."""

    FINISHED = "the stop time was reached"
    INTERRUPTED = "it was interrupted"
    STEP_BUDGET = "the largest number of attempts was reached"
    FAILED = "it failed"
    TIME_BUDGET = "the wall time allowed was used up"


@dataclass(frozen=True, slots=True, kw_only=True)
class Switch:
    """An indicator changed its side.

    Attributes
    ----------
    time : float
        When [s].
    indicator : str
        Which, as ``participant.variable``.
    positive : bool
        Whether it is positive from then on.
    """

    time: float
    indicator: str
    positive: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class Statistics:
    """Counts of a run.

    Attributes
    ----------
    accepted : int
        Accepted steps.
    rejected : mapping of str to int
        Rejected attempts by cause: error, event, convergence, discard, invalid.
    iterations : int
        Steppings of the coupled participants over all attempts.
    switches : int
        Located changes of side.
    """

    accepted: int
    rejected: Mapping[str, int]
    iterations: int
    switches: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """How a run ended.

    Attributes
    ----------
    end_time : float
        Last accepted time [s].
    reason : StopReason
        Why it ended.
    statistics : Statistics
        Its counts.
    step_log : numpy.ndarray, shape (n_attempts,)
        One row per attempt, see `orchestrator.step_log.row_type`.
    switches : tuple of Switch
        Located changes of side.
    wall_time : float
        Seconds from instantiation to the end.
    warnings : tuple of str
        What makes the result doubtful, a sentence each.
    failure : str
        Why it failed, a sentence; empty unless it did.
    unreliable : tuple of str
        What makes it wrong, although the run went on, a sentence each.
    audit : AuditReport or None
        What repeating steps in halves found, if the settings wanted it.
    bonds : tuple of BondReport
        Energy that every bond made or lost.
    """

    end_time: float
    reason: StopReason
    statistics: Statistics
    step_log: NDArray[np.void]
    switches: tuple[Switch, ...]
    wall_time: float
    warnings: tuple[str, ...] = ()
    failure: str = ""
    unreliable: tuple[str, ...] = ()
    audit: AuditReport | None = None
    bonds: tuple[BondReport, ...] = ()

    @property
    def finished(self) -> bool:
        """Whether the stop time was reached."""
        return self.reason is StopReason.FINISHED
