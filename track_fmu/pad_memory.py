"""What viscoelastic pads remember between two steps."""

from __future__ import annotations

from typing import NamedTuple

from .assembly import IntArray
from .beam_element import FloatArray


class PadMemory(NamedTuple):
    """Views into the state of a track, (supports,) each.

    Attributes
    ----------
    branch_force : float array
        Force in the branch of spring and dashpot in series [N].
    compression : float array
        Of the pad at the end of the last step [m].
    known : float array
        1 where the pad was accounted for in that step; 0 where the rest means nothing.
    """

    branch_force: FloatArray
    compression: FloatArray
    known: FloatArray

    def keep(self, support: IntArray, branch_force: FloatArray, compression: FloatArray) -> None:
        """Take over what the given supports' pads remember."""
        self.branch_force[support] = branch_force
        self.compression[support] = compression
        self.known[support] = 1.0

    def forget(self) -> None:
        """Forget everything."""
        for values in self:
            values[:] = 0.0
