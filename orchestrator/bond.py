"""Connections that carry power together."""

from dataclasses import dataclass
from typing import Literal

from .errors import WiringError
from .system import System

lengths = ("m", "mm", "rad", "deg")
"""Units of a displacement that a force or a moment acts along."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Bond:
    """Two connections that carry power together, in opposite directions.

    Attributes
    ----------
    force : str
        Output of one participant that drives the other: a force or a moment.
    motion : str
        Output of the other that drives the first: the displacement or velocity that `force` acts
        along.
    kind : {'displacement', 'velocity'}
        Which of the two `motion` is.
    """

    force: str
    motion: str
    kind: Literal["displacement", "velocity"]


def bond_by_unit(system: System, force: str, motion: str) -> Bond:
    """Return the bond of two outputs; the unit says what the motion is.

    Raises
    ------
    WiringError
        For an output that does not exist, or whose unit is neither that of a length or an angle
        nor that of one per second.
    """
    system.find(force)
    unit = system.find(motion)[1].unit
    base, _, per = (unit or "").partition("/")
    if base not in lengths or per not in {"", "s"}:
        raise WiringError(
            f"{motion} {f'has the unit {unit!r}' if unit else 'declares no unit'}, but the motion "
            f"of a bond is in {', '.join(lengths)}, or one of them per s."
        )
    return Bond(force=force, motion=motion, kind="velocity" if per else "displacement")
