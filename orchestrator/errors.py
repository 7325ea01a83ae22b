"""Errors of the master: each message is one sentence for the person who runs the co-simulation."""

from collections.abc import Iterable, Mapping, Sequence
from difflib import get_close_matches

from .last_attempt import LastAttempt
from .outcome import Outcome

most_inputs = 12
"""Values that a message shows."""

most_names = 4
"""Names that a message shows."""


class OrchestratorError(Exception):
    """Base of every error the package raises on purpose."""


class InputError(OrchestratorError, ValueError):
    """What the user gave is wrong: nothing has been simulated."""


class RunError(OrchestratorError, RuntimeError):
    """The co-simulation had to stop.

    Attributes
    ----------
    outcome : Outcome or None
        How far it came; None where it had not begun to step.
    last_attempt : LastAttempt or None
        What it takes to repeat the attempt that failed, where every participant can serialise its
        state and has not died.
    """

    outcome: Outcome | None = None
    last_attempt: LastAttempt | None = None


class SettingsError(InputError):
    """A master setting is out of range or contradicts another one."""


class FmuError(InputError):
    """A file is no usable FMI 2.0 or 3.0 co-simulation FMU, or a start value does not fit it."""


class SystemFileError(InputError):
    """A system description, or a file that belongs to it, cannot be used."""


class WiringError(InputError):
    """Participants, connections, indicators or recorded names do not fit together."""


class InitialisationError(RunError):
    """The initial values of a loop of connections did not settle."""


class RollbackError(RunError):
    """A participant cannot go back to a saved state, or does not do it truly."""


class LoopGainError(RunError):
    """A loop answers too strongly for an explicit algorithm."""


class DivergenceError(RunError):
    """An explicit algorithm loses the values it should follow."""


class StepTooSmallError(RunError):
    """The step would have to become smaller than the smallest one allowed."""


class ZenoError(RunError):
    """Switches follow one another without end."""


class ParticipantError(RunError):
    """A participant failed while it was used.

    Parameters
    ----------
    participant : str
        Name of the participant.
    failure : str
        What it refused, for example ``"the step ended with fmi2Fatal"``.
    time, step_size : float, optional
        Start [s] and size [s] of the step in question.
    inputs : mapping of str to float, optional
        The inputs of that step.
    messages : sequence of str, optional
        Last messages the participant logged.
    """

    def __init__(
        self,
        *,
        participant: str,
        failure: str,
        time: float | None = None,
        step_size: float | None = None,
        inputs: Mapping[str, float] | None = None,
        messages: Sequence[str] = (),
    ) -> None:
        self.participant = participant
        self.failure = failure
        self.time = time
        self.step_size = step_size
        self.inputs = dict(inputs or {})
        self.messages = tuple(messages)
        where = "" if time is None else f" at t = {time:.9g} s"
        if step_size is not None:
            where += f" over a step of {step_size:.6g} s"
        values = f" with {list_inputs(self.inputs)}" if self.inputs else ""
        log = f"; it logged: {' | '.join(self.messages)}" if self.messages else ""
        super().__init__(f"{participant}: {failure}{where}{values}{log}.")


def without_log(message: str) -> str:
    """Return a message without what a participant logged."""
    return message.partition("; it logged: ")[0].rstrip(".")


def list_inputs(inputs: Mapping[str, float]) -> str:
    """Return ``"a = 1, b = 2"``, at most `most_inputs` of them."""
    shown = [f"{name} = {value:.9g}" for name, value in list(inputs.items())[:most_inputs]]
    if len(inputs) > most_inputs:
        shown.append(f"{len(inputs) - most_inputs} more")
    return ", ".join(shown)


def list_names(names: Sequence[str]) -> str:
    """Return ``"a, b and c"``, at most `most_names` of them."""
    shown = list(names[:most_names])
    if len(names) > most_names:
        shown.append(f"{len(names) - most_names} more")
    return " and ".join([*filter(None, [", ".join(shown[:-1])]), *shown[-1:]])


def close_matches(name: str, known: Iterable[str]) -> str:
    """Return a clause about an unknown name: the names that look like it, or the first ones."""
    known = list(known)
    similar = get_close_matches(name, known, n=3, cutoff=0.6)
    if similar:
        return "perhaps " + " or ".join(repr(match) for match in similar) + " is meant"
    if not known:
        return "there are none"
    listed = ", ".join(repr(match) for match in known[:8])
    return f"known are {listed}" + (f" and {len(known) - 8} more" if len(known) > 8 else "")
