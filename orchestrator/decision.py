"""What can become of an attempted step: values, not exceptions."""

from enum import IntEnum
from typing import NamedTuple

from .errors import ParticipantError


class Cause(IntEnum):
    """Why an attempt is rejected; also the code in the step log, where 0 means accepted."""

    ERROR = 1
    """Prediction and result differ by more than the tolerance."""
    EVENT = 2
    """An indicator changed its side within the step."""
    CONVERGENCE = 3
    """The coupling iteration did not converge."""
    DISCARD = 4
    """A participant refused the step."""
    INVALID = 5
    """A participant reported an error or gave values that are not finite."""


class Failure(NamedTuple):
    """Why an attempt has no result.

    Attributes
    ----------
    cause : Cause
        CONVERGENCE, DISCARD or INVALID.
    message : str
        A clause that names the participant or the unknown and what went wrong.
    last_successful_time : float or None
        Up to where the participant that refused could compute [s].
    ends_early : bool
        Whether the step has to be repeated up to exactly there.
    participant_error : ParticipantError or None
        The error a participant reported, which is forgiven once.
    """

    cause: Cause
    message: str
    last_successful_time: float | None = None
    ends_early: bool = False
    participant_error: ParticipantError | None = None


class Refine(NamedTuple):
    """The attempt does not end on the switch that lies in its bracket.

    Attributes
    ----------
    next_step : float
        Step size to try next [s].
    crossed : bool
        Whether the attempt ends beyond the switch.
    """

    next_step: float
    crossed: bool


class Landed(NamedTuple):
    """The attempt ends on a switch.

    Attributes
    ----------
    switched : tuple of int
        Indicators that change their side.
    """

    switched: tuple[int, ...]


class Candidate(NamedTuple):
    """An attempted step, before it is decided on.

    Attributes
    ----------
    time, step_size : float
        Start and size [s].
    failure : Failure or None
        Why there is no result, if there is none.
    finding : Refine or Landed or None
        What the indicators say of the result; None: no switch.
    error_norm : float
        Difference of prediction and result over the tolerance, as if the step before had been of
        the same size; NaN when nothing was predicted.
    iterations : int
        How often the coupled participants were stepped.
    residual_norm : float
        What is left of the coupling equations, over the nominal values; NaN when not iterated.
    """

    time: float
    step_size: float
    failure: Failure | None
    finding: Refine | Landed | None
    error_norm: float
    iterations: int
    residual_norm: float


class Accept(NamedTuple):
    """Keep the candidate and go on.

    Attributes
    ----------
    next_step : float
        Size wanted for the next step [s].
    """

    next_step: float


class Reject(NamedTuple):
    """Throw the candidate away, go back and try again.

    Attributes
    ----------
    cause : Cause
        Why.
    next_step : float
        Size of the next attempt [s].
    exactly : bool
        Whether the next attempt must have that size to the bit, however small.
    """

    cause: Cause
    next_step: float
    exactly: bool = False


Decision = Accept | Reject
