"""What two connections that carry power together made or lost of it."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class BondReport:
    """Energy that a bond made out of nothing or lost.

    Attributes
    ----------
    force, motion : str
        The bond.
    residual : float
        Work that the participant with the motion saw less the work that the other one saw, in the
        product of the units of the outputs: J for N and m or m/s.
    largest : float
        Largest magnitude of the residual on the way.
    exchanged : float
        Work exchanged, each step counted as positive.
    """

    force: str
    motion: str
    residual: float
    largest: float
    exchanged: float

    @property
    def relative(self) -> float:
        """Largest residual over the work exchanged, 0 where nothing was."""
        return self.largest / self.exchanged if self.exchanged else 0.0
