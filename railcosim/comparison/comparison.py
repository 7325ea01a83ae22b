"""What comparing two results gave."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .facts import FactDifference
    from .measures import Measures


@dataclass(frozen=True, slots=True, kw_only=True)
class SignalComparison:
    """One signal.

    Attributes
    ----------
    name, unit : str
        The signal.
    reasons : tuple of str
        Why it differs, in a few words each; empty if it agrees.
    measures : Measures or None
        How far it is from the baseline; None if a value is not finite.
    allowed : float
        Height of the tube to each side [unit], infinity for any.
    time_tolerance : float
        Width of the tube to each side [s].
    """

    name: str
    unit: str
    reasons: tuple[str, ...]
    measures: Measures | None
    allowed: float
    time_tolerance: float

    @property
    def agrees(self) -> bool:
        """Whether all of it is within the tolerance."""
        return not self.reasons


@dataclass(frozen=True, slots=True, kw_only=True)
class Comparison:
    """What comparing a result with its baseline gave.

    Attributes
    ----------
    result, baseline : str
        Their names.
    interval : tuple of float
        What they have in common [s]; this was compared.
    problems : tuple of str
        What differs as a whole: start or end.
    missing : tuple of str
        Signals that only the baseline has; they count as differing.
    signals : tuple of SignalComparison
        Those that both have, in the order of the baseline.
    extra : tuple of str
        Signals that only the result has, as information.
    facts : tuple of FactDifference
        Attributes that differ, as information.
    notes : tuple of str
        What else is worth knowing.
    """

    result: str
    baseline: str
    interval: tuple[float, float]
    problems: tuple[str, ...]
    missing: tuple[str, ...]
    signals: tuple[SignalComparison, ...]
    extra: tuple[str, ...]
    facts: tuple[FactDifference, ...]
    notes: tuple[str, ...]

    @property
    def agrees(self) -> bool:
        """Whether the result is the baseline within the tolerances."""
        return not (self.problems or self.missing or self.differing)

    @property
    def differing(self) -> tuple[SignalComparison, ...]:
        """Signals that differ."""
        return tuple(signal for signal in self.signals if not signal.agrees)

    def verdict(self) -> str:
        """Say in one sentence what came of it."""
        count = len(self.signals)
        parts = [*self.problems]
        if self.missing:
            parts.append(f"{listed(self.missing)} missing")
        if self.differing:
            names = listed([signal.name for signal in self.differing])
            parts.append(f"{len(self.differing)} of {count} signals differ ({names})")
        if not parts:
            return f"{self.result} agrees with {self.baseline} in {count} signals"
        return f"{self.result} differs from {self.baseline}: {'; '.join(parts)}"

    def numbers(self) -> dict[str, Any]:
        """Return everything as plain data without infinities, which become None; SI units."""
        signals = {}
        for signal in self.signals:
            measures = signal.measures
            signals[signal.name] = {
                "agrees": signal.agrees,
                "reasons": list(signal.reasons),
                "unit": signal.unit,
                "allowed": _finite(signal.allowed),
                "time_tolerance": signal.time_tolerance,
            } | (
                {}
                if measures is None
                else {name: _finite(value) for name, value in asdict(measures).items()}
                | {"peak_difference": _finite(measures.peak_difference)}
            )
        return {
            "agrees": self.agrees,
            "result": self.result,
            "baseline": self.baseline,
            "interval": list(self.interval),
            "problems": list(self.problems),
            "missing": list(self.missing),
            "extra": list(self.extra),
            "signals": signals,
            "facts": [asdict(fact) for fact in self.facts],
            "notes": list(self.notes),
        }


def listed(names: Sequence[str], most: int = 5) -> str:
    """Name a few of many."""
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + more


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
