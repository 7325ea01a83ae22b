"""Replay files: the last attempt of a run that failed, to be repeated anywhere."""

from .case import ReplayCase
from .reading import open_replay
from .repetition import Repetition, repeat
from .trace import TraceRow
from .writing import write_replay

__all__ = [
    "Repetition",
    "ReplayCase",
    "TraceRow",
    "open_replay",
    "repeat",
    "write_replay",
]
