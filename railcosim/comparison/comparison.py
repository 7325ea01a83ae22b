"""Two results, signal by signal."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import InputError
from .facts import FactDifference, differing_facts
from .measures import Measures, measure
from .polyline import Polyline
from .reading import Source, record
from .tolerances import TIME_FRACTION, Tolerance, Tolerances, matches

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from .recording import Recording, Series


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
            parts.append(f"{_listed(self.missing)} missing")
        if self.differing:
            names = _listed([signal.name for signal in self.differing])
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


def compare(
    result: Source,
    baseline: Source,
    tolerances: Tolerances | None = None,
    *,
    signals: Sequence[str] = (),
) -> Comparison:
    """Compare a result with its baseline on what they have in common in time.

    Parameters
    ----------
    result, baseline : xarray.Dataset, structured ndarray, str, Path or Recording
        Results, or files that hold them: .nc, .csv or .parquet.
    tolerances : Tolerances, optional
        What is allowed; the defaults without.
    signals : sequence of str
        Patterns of the signals to compare, in which ``*`` stands for any text; all without.

    Returns
    -------
    Comparison
        The numbers and a verdict.

    Raises
    ------
    InputError
        For results that cannot be read or have nothing in common.
    """
    new, old = record(result, "the result"), record(baseline, "the baseline")
    allowed = tolerances or Tolerances()
    wanted = _wanted(old.series, allowed, signals)
    common = [name for name in wanted if name in new.series]
    if not common:
        raise InputError(
            f"{new.name} and {old.name} have none of the signals to compare in common: the "
            f"baseline has {_listed(list(old.series)) or 'none'}, the result has "
            f"{_listed(list(new.series)) or 'none'}"
        )
    start, stop = _common_interval(new, old)
    compared = tuple(
        _compare_signal(name, new, old, allowed.of(name), (start, stop)) for name in common
    )
    return Comparison(
        result=new.name,
        baseline=old.name,
        interval=(start, stop),
        problems=tuple(_ends(new, old, allowed)),
        missing=tuple(name for name in wanted if name not in new.series),
        signals=compared,
        extra=tuple(
            name for name in _wanted(new.series, allowed, signals) if name not in old.series
        ),
        facts=differing_facts(new.facts, old.facts),
        notes=tuple(_notes(new, old, allowed, signals)),
    )


def _wanted(names: Iterable[str], tolerances: Tolerances, signals: Sequence[str]) -> list[str]:
    return [
        name
        for name in names
        if not tolerances.ignores(name)
        and (not signals or any(matches(name, pattern) for pattern in signals))
    ]


def _common_interval(new: Recording, old: Recording) -> tuple[float, float]:
    start = float(max(new.times[0], old.times[0]))
    stop = float(min(new.times[-1], old.times[-1]))
    if not start < stop:
        raise InputError(
            f"{new.name} ({_interval(new)}) and {old.name} ({_interval(old)}) have no time in "
            "common: give results of the same run"
        )
    return start, stop


def _ends(new: Recording, old: Recording, tolerances: Tolerances) -> Iterable[str]:
    """Yield what is different about start and end."""
    allowed = tolerances.interval
    if allowed is None:
        allowed = _half_width(tolerances.default, (float(old.times[0]), float(old.times[-1])))
    for word, k in (("starts", 0), ("ends", -1)):
        if abs(new.times[k] - old.times[k]) > allowed:
            yield f"it {word} at {new.times[k]:.9g} s, the baseline at {old.times[k]:.9g} s"


def _compare_signal(
    name: str, new: Recording, old: Recording, tolerance: Tolerance, interval: tuple[float, float]
) -> SignalComparison:
    result, baseline = new.series[name], old.series[name]
    half_width = _half_width(tolerance, interval)
    reasons = [
        *_unlike(result, baseline),
        *_not_finite("the result", new, result),
        *_not_finite("the baseline", old, baseline),
    ]
    measures, allowed = None, tolerance.absolute
    if all(np.isfinite(series.values).all() for series in (result, baseline)):
        held = baseline.held
        measures = measure(
            Polyline.through(new.times, result.values, held=held).cut(*interval),
            Polyline.through(old.times, baseline.values, held=held).cut(*interval),
            half_width,
        )
        height = tolerance.value * measures.scale if measures.scale > 0.0 else 0.0
        allowed = max(height, tolerance.absolute)
        reasons += _exceeded(measures, tolerance, allowed)
    return SignalComparison(
        name=name,
        unit=baseline.unit or result.unit,
        reasons=tuple(reasons),
        measures=measures,
        allowed=allowed,
        time_tolerance=half_width,
    )


def _half_width(tolerance: Tolerance, interval: tuple[float, float]) -> float:
    if tolerance.time is not None:
        return min(tolerance.time, interval[1] - interval[0])
    return TIME_FRACTION * (interval[1] - interval[0])


def _unlike(result: Series, baseline: Series) -> Iterable[str]:
    if result.unit and baseline.unit and result.unit != baseline.unit:
        yield f"in {result.unit}, baseline in {baseline.unit}"


def _not_finite(what: str, recording: Recording, series: Series) -> Iterable[str]:
    wrong = np.flatnonzero(~np.isfinite(series.values))
    if wrong.size:
        yield (
            f"{what} has {wrong.size} values that are no finite numbers, the first at "
            f"{recording.times[wrong[0]]:.6g} s"
        )


def _exceeded(measures: Measures, tolerance: Tolerance, allowed: float) -> Iterable[str]:
    """Yield which tolerances are exceeded."""
    if measures.excess > allowed:
        yield f"outside the tube at {measures.excess_time:.6g} s"
    for word, value, limit in (
        ("nrms", measures.nrms, tolerance.nrms),
        ("peak", abs(measures.peak_difference), tolerance.peak),
        ("shift", abs(measures.shift), tolerance.shift),
    ):
        if value > limit:
            yield f"{word} above {limit:g}"


def _notes(
    new: Recording, old: Recording, tolerances: Tolerances, signals: Sequence[str]
) -> Iterable[str]:
    """Yield what was asked for without effect, and what could not be compared."""
    names = [*old.series, *new.series]
    for pattern in [*tolerances.signals, *tolerances.ignore, *signals]:
        if not any(matches(name, pattern) for name in names):
            yield f"no signal is of the pattern {pattern}"
    for recording in (new, old):
        if recording.left_out:
            yield f"{recording.name}: no numbers in {_listed(recording.left_out)}"


def _interval(recording: Recording) -> str:
    return f"{recording.times[0]:.6g} to {recording.times[-1]:.6g} s"


def _listed(names: Sequence[str], most: int = 5) -> str:
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + more


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
