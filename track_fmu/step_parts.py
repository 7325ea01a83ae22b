"""Into how many equal parts a step is divided."""

import math

MOST_PARTS = 1e5  # beyond it a step says nothing about how forces and wheels have moved


def count_parts(step_size: float, longest: float) -> int:
    """Return the smallest number of parts that are not longer than a length.

    Parameters
    ----------
    step_size, longest : float
        Lengths of the step and of its longest part [s].

    Raises
    ------
    ValueError
        If the step is not a finite number above zero or more than `MOST_PARTS`.
    """
    if not (math.isfinite(step_size) and step_size > 0.0):
        raise ValueError(f"track: step size {step_size!r} s must be greater than 0")
    if step_size / longest > MOST_PARTS:
        raise ValueError(
            f"track: a step of {step_size:g} s is more than {MOST_PARTS:g} parts of {longest:g} s; "
            "use a shorter step"
        )
    return max(1, math.ceil(step_size / longest - 1e-9))
