"""Stdout kept for results: what FMUs print goes to stderr."""

import ctypes
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout


@contextmanager
def stdout_for_results() -> Iterator[None]:
    """Send everything that is printed in the block to stderr, by Python and by shared libraries."""
    if sys.stdout is None:  # it was closed by who started the program
        yield
        return
    sys.stdout.flush()
    kept = os.dup(1)
    try:
        os.dup2(2, 1)
        with redirect_stdout(sys.stderr):
            yield
    finally:
        # What C still holds in its buffer would come out after the result.
        ctypes.CDLL(None).fflush(None)
        os.dup2(kept, 1)
        os.close(kept)
