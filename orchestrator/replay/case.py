"""A run that failed, as data."""

from dataclasses import dataclass

from ..fmu_source import FmuSource
from ..last_attempt import LastAttempt
from ..settings import MasterSettings
from ..system import Connection


@dataclass(frozen=True, slots=True, kw_only=True)
class ReplayCase:
    """What it takes to repeat how a run ended.

    Attributes
    ----------
    name : str
        Name of the system.
    sources : tuple of FmuSource
        Its FMUs.
    connections : tuple of Connection
        Its connections.
    settings : MasterSettings
        Settings of the master; the algorithm and the step control are theirs.
    events, observed : tuple of str
        Event indicators and observed variables as ``participant.variable``.
    start_time, stop_time : float
        Span of the run [s].
    error : str
        How the run ended, a sentence.
    attempt : LastAttempt or None
        The attempt that failed; None where the whole run must be repeated.
    """

    name: str
    sources: tuple[FmuSource, ...]
    connections: tuple[Connection, ...]
    settings: MasterSettings
    events: tuple[str, ...] = ()
    observed: tuple[str, ...] = ()
    start_time: float
    stop_time: float
    error: str = ""
    attempt: LastAttempt | None = None
