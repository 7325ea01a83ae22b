"""What a host is told to do, and what it tells."""

import json
import sys
from collections.abc import Sequence
from typing import Any, NamedTuple


class Job(NamedTuple):
    """Two instances of one FMU, y of each connected to u of the other.

    Attributes
    ----------
    fmu : str
        Path of the FMU.
    steps : int
        Number of macro steps.
    step_size : float
        Their size [s].
    partners : mapping of str to mapping of str to float
        Parameters of each instance.
    """

    fmu: str
    steps: int
    step_size: float
    partners: dict[str, dict[str, float]]

    @classmethod
    def read(cls) -> "Job":
        """Return the job in the first argument."""
        fields: dict[str, Any] = json.loads(sys.argv[1])
        return cls(**fields)


def report(seconds: float, final: Sequence[float]) -> None:
    """Tell how long all steps took [s] and the last outputs."""
    print(json.dumps({"seconds": seconds, "final": list(final)}))
