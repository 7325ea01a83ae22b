"""Whether a step goes on from where a slave is."""

from __future__ import annotations

import math

TIME_TOLERANCE = 1e-9  # relative; a master's and a slave's sums of steps may differ by rounding


def step_complaint(reached: float, current_time: float, step_size: float) -> str | None:
    """Say why a step does not continue in time, or None.

    Parameters
    ----------
    reached : float
        Communication point of the slave [s].
    current_time, step_size : float
        Start and length of the step [s].
    """
    if not math.isclose(current_time, reached, rel_tol=TIME_TOLERANCE, abs_tol=1e-12):
        return (
            f"a step from {current_time!r} s does not continue from "
            f"{reached!r} s; restore the state of that time first"
        )
    if step_size > 0.0 and current_time + step_size == current_time:
        return (
            f"a step of {step_size:g} s from {current_time!r} s does not move the time on; use "
            "a longer one"
        )
    return None
