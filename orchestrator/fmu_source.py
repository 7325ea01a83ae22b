"""What it takes to open an FMU as a participant, here or in a process of its own."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from .fmu import FmuParticipant, StartValue
from .isolated import IsolatedParticipant


@dataclass(frozen=True, slots=True, kw_only=True)
class FmuSource:
    """An FMU and its part in a system.

    Attributes
    ----------
    path : pathlib.Path
        The FMU.
    name : str
        Name in the system.
    start_values : mapping of str to float, int, bool or str
        Values to set before the initialisation.
    timeout : float or None
        Longest answer to one call [s], the FMU then being in a process of its own; None for this
        process and no limit.
    """

    path: Path
    name: str
    start_values: Mapping[str, StartValue] = field(default_factory=dict)
    timeout: float | None = None

    def open(self) -> FmuParticipant | IsolatedParticipant:
        """Return the participant.

        Raises
        ------
        InputError
            When the file, a start value or the time-out is not usable.
        """
        if self.timeout is None:
            return FmuParticipant(self.path, name=self.name, start_values=self.start_values)
        return IsolatedParticipant(
            self.path, name=self.name, start_values=self.start_values, timeout=self.timeout
        )
