"""FMUs as participants: FMI 2.0 and 3.0 for co-simulation."""

from .described import DescribedFmu
from .description import StartValue
from .participant import FmuParticipant

__all__ = ["DescribedFmu", "FmuParticipant", "StartValue"]
