"""The library of a Python FMU, ended before the C++ runtime takes its objects away.

At the exit of a process pythonfmu 0.7 gives its Python state back twice: as a static object, and
from a function that the loader calls for the library later, through a pointer into memory that is
free by then. What lies there now is damaged; some processes crash. The library exports the function
that gives the state back and clears the pointer; once it has been called, neither does harm.
"""

from __future__ import annotations

import atexit
import ctypes
import os
import sys
import threading
from collections.abc import Callable
from functools import cache
from pathlib import Path

END = "finalizePythonInterpreter"


def end_in_order(resources: str | None) -> None:
    """Give back the Python state of an FMU's library while that is still there.

    Parameters
    ----------
    resources : str or None
        Folder of the resources of the unpacked FMU; None where the slave runs without a library.
    """
    if resources is not None and sys.platform == "linux":
        for library in (Path(resources).parent / "binaries" / "linux64").glob("*.so"):
            _end_at_exit(library)


@cache
def _end_at_exit(library: Path) -> None:
    end = getattr(ctypes.CDLL(str(library)), END, None)  # the handle that the host has already
    if end is not None:
        atexit.register(_end, end)


def _end(end: Callable[[], object]) -> None:
    """Call it, unless the library itself has started Python, in a thread that waits for Python."""
    if threading.get_native_id() == os.getpid():
        end()
