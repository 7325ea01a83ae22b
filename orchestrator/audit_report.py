"""What repeating steps in halves tells about their accuracy."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class AuditReport:
    """What an audit found.

    Attributes
    ----------
    steps : int
        Accepted steps that were repeated in two halves.
    failed : int
        Those of them whose halves had no result.
    underestimated : int
        Those in which the measured difference exceeded the miss of the prediction.
    variable : str
        Exchanged value with the largest difference, or ``""`` if nothing was measured.
    difference : float
        That difference, in its unit: 3/4 of the local error where the coupling is of second
        order, 1/2 where it is of first.
    relative : float
        It over the largest magnitude of that value at audited steps.
    optimism : float or None
        `relative` over the tolerance; None without error control.
    """

    steps: int
    failed: int
    underestimated: int
    variable: str
    difference: float
    relative: float
    optimism: float | None
