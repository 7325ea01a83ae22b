"""The section ``[keep]`` of a scenario and of a study: which histories are kept, how closely."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from .errors import InputError
from .signals import BODY_SIGNALS, SIGNALS, SLEEPER_SIGNALS

if TYPE_CHECKING:
    from collections.abc import Mapping

    from .signals import Signal

KEPT: Mapping[str, Signal] = {
    signal.name: signal
    for signal in (*SIGNALS, *BODY_SIGNALS, *SLEEPER_SIGNALS)
    if signal.name != "in_contact"
}
"""Signals that can be kept: those with values between two points; the gap tells of contact."""

FINEST = 1e-5
"""Smallest spacing of the grid [m]: the distance rolled in a microsecond at 36 km/h."""

SHORTEST = 1.0
"""Shortest stretch whose extremes are kept [m]: a thousand of them a kilometre stay in memory."""

LARGEST = 1e9
"""Positions end before this [m], and with them all distances."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Keep:
    """Keys of ``[keep]``; a scenario without them keeps every history at every step.

    Attributes
    ----------
    signals : tuple of str
        Names of `KEPT`; a list becomes a tuple.
    spacing : float, optional
        Distance of neighbouring points [m]; the points are whole multiples of it, 0 where the
        flat's centre meets the rail. Needed with signals.
    stretch : float
        Length of the stretches of which the extremes over all steps are kept [m]; they end at
        whole multiples of it.

    Raises
    ------
    InputError
        For another signal, or a distance that is none.
    """

    signals: tuple[str, ...] = ()
    spacing: float | None = None
    stretch: float = 100.0

    def __post_init__(self) -> None:
        if not isinstance(self.signals, (list, tuple)):
            raise InputError(f"keep.signals is {self.signals!r} but must be a list of names")
        unknown = [name for name in self.signals if not isinstance(name, str) or name not in KEPT]
        if unknown:
            raise InputError(
                f"keep.signals is {list(self.signals)} but must name some of {', '.join(KEPT)}"
            )
        if len(set(self.signals)) < len(self.signals):
            raise InputError(f"keep.signals is {list(self.signals)}: name every signal once")
        object.__setattr__(self, "signals", tuple(self.signals))
        if self.spacing is not None:
            object.__setattr__(self, "spacing", _distance("spacing", self.spacing, FINEST))
        object.__setattr__(self, "stretch", _distance("stretch", self.stretch, SHORTEST))
        if self.signals and self.spacing is None:
            raise InputError(
                "keep.spacing is missing: give the distance of neighbouring points [m]"
            )
        if self.spacing is not None and not self.signals:
            raise InputError(
                f"keep.signals names nothing but must name some of {', '.join(KEPT)}: add them, or "
                "leave keep.spacing out"
            )

    @property
    def is_all(self) -> bool:
        """Whether every history is kept at every step."""
        return not self.signals

    @property
    def grid_spacing(self) -> float:
        """Distance of neighbouring points [m], where there are any."""
        if self.spacing is None:
            raise ValueError("every step is kept: there is no spacing")
        return self.spacing

    def grid(self, start: float, end: float) -> tuple[int, int]:
        """Return the first multiple of the spacing in an interval and the one after its last.

        Parameters
        ----------
        start, end : float
            The interval [m].
        """
        margin = 1e-9  # of the spacing: 0.3 is the third multiple of 0.1
        first = math.ceil(start / self.grid_spacing - margin)
        return first, math.floor(end / self.grid_spacing + margin) + 1

    def need_all(self, what: str) -> None:
        """Refuse what works on whole histories.

        Parameters
        ----------
        what : str
            What needs them, for the message.

        Raises
        ------
        InputError
            Unless every history is kept.
        """
        if not self.is_all:
            raise InputError(
                f"{what} needs every history at every step but the scenario keeps "
                f"{', '.join(self.signals)} every {self.spacing:g} m: take its [keep] out"
            )


def read_keep(given: Mapping[str, Any]) -> Keep:
    """Return the ``[keep]`` of a study, which keeps signals over a distance common to all cases.

    Raises
    ------
    InputError
        For an unknown key or a value that does not fit.
    """
    allowed = "signals", "spacing"
    for name in given:
        if name not in allowed:
            raise InputError(f"{name} is no key of [keep], which are {', '.join(allowed)}")
    if "signals" not in given:
        raise InputError(f"keep.signals is missing: name some of {', '.join(KEPT)}")
    return Keep(**given)


def _distance(key: str, value: object, least: float) -> float:
    if isinstance(value, (int, float)) and not isinstance(value, bool) and least <= value < LARGEST:
        return float(value)
    raise InputError(f"keep.{key} is {value!r} but must be a distance of at least {least:g} m")
