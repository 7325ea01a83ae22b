"""Repeating how a run ended."""

from dataclasses import dataclass

from ..errors import RunError, without_log
from ..master import Master
from ..system import System
from .case import ReplayCase
from .trace import Trace, TraceRow, traced_control, traced_participant


@dataclass(frozen=True, slots=True, kw_only=True)
class Repetition:
    """What came of repeating the end of a run.

    Attributes
    ----------
    message : str
        How it ended this time; empty if it did not fail.
    reproduced : bool
        Whether that is how the run ended, but for what participants logged.
    from_start : bool
        Whether the whole run was repeated, or its last attempt from the saved states.
    rows : tuple of TraceRow
        What every participant was told and answered in the last attempt.
    """

    message: str
    reproduced: bool
    from_start: bool
    rows: tuple[TraceRow, ...]


def repeat(case: ReplayCase) -> Repetition:
    """Repeat how a run ended: its last attempt from the saved states, else all of it.

    Parameters
    ----------
    case : ReplayCase
        The run.

    Raises
    ------
    InputError
        When its FMUs cannot be used or do not fit together.
    """
    trace = Trace(case.observed)
    system = System(
        [traced_participant(source.open(), trace) for source in case.sources], case.connections
    )
    control = case.settings.make_controller(case.stop_time - case.start_time)
    master = Master(
        system,
        case.settings,
        controller=traced_control(control, trace),
        events=case.events,
        observers=[trace],
    )
    try:
        if case.attempt is None:
            master.run(case.start_time, case.stop_time)
            message = ""
        else:
            message = master.repeat(case.start_time, case.stop_time, case.attempt) or ""
    except RunError as error:
        message = str(error)
    return Repetition(
        message=message,
        reproduced=bool(message) and without_log(message) in case.error,
        from_start=case.attempt is None,
        rows=tuple(trace.rows),
    )
