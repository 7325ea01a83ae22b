"""Two results, signal by signal."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..errors import InputError
from .comparison import Comparison, SignalComparison, listed
from .facts import differing_facts
from .measures import Measures, measure
from .polyline import Polyline
from .reading import Source, record
from .tolerances import TIME_FRACTION, Tolerance, Tolerances, matches

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from .recording import Recording, Series


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
            f"baseline has {listed(list(old.series)) or 'none'}, the result has "
            f"{listed(list(new.series)) or 'none'}"
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
            yield f"{recording.name}: no numbers in {listed(recording.left_out)}"


def _interval(recording: Recording) -> str:
    return f"{recording.times[0]:.6g} to {recording.times[-1]:.6g} s"
