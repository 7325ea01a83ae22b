"""Regression: a result beside its baseline, signal by signal, within tolerances."""

from .comparing import compare
from .comparison import Comparison, SignalComparison
from .measures import Measures
from .overlays import write_overlays
from .reading import Source, read_recording, record
from .recording import Recording
from .tolerances import Tolerance, Tolerances, read_tolerances
from .verdicts import comparison_table, comparison_text

__all__ = [
    "Comparison",
    "Measures",
    "Recording",
    "SignalComparison",
    "Source",
    "Tolerance",
    "Tolerances",
    "compare",
    "comparison_table",
    "comparison_text",
    "read_recording",
    "read_tolerances",
    "record",
    "write_overlays",
]
