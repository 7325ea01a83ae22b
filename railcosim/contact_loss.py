"""Where a wheel is off the rail, from its signed gap."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


def contact_losses(x: NDArray[np.float64], gap: NDArray[np.float64]) -> list[tuple[float, float]]:
    """Find the intervals in which the gap is above zero, the gap being straight between points.

    The master lands on every switch, so the gap is zero there to rounding, on either side; straight
    lines make the result independent of which side it was.

    Parameters
    ----------
    x : ndarray, shape (n,)
        Increasing abscissa, time [s] or distance [m].
    gap : ndarray, shape (n,)
        Signed gap [m], positive apart.

    Returns
    -------
    list of (float, float)
        Start and end of every loss of contact, in the unit of ``x``.
    """
    change = np.flatnonzero((gap[:-1] > 0.0) != (gap[1:] > 0.0))
    share = gap[change] / (gap[change] - gap[change + 1])
    switches = list(x[change] + share * (x[change + 1] - x[change]))
    if gap.size and gap[0] > 0.0:
        switches.insert(0, x[0])
    if gap.size and gap[-1] > 0.0:
        switches.append(x[-1])
    return [(float(a), float(b)) for a, b in zip(switches[::2], switches[1::2], strict=True)]
