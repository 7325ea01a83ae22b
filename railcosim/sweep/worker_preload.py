"""Loaded by the worker processes on this machine: Ctrl-C is for the process that started them."""

from __future__ import annotations

import signal
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from distributed import Worker


def dask_setup(_: Worker) -> None:
    """Leave Ctrl-C, which the terminal sends to all processes, to the one that ends the others."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
