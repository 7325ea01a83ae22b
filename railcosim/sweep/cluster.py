"""The workers of a sweep: processes on this machine, or those of a scheduler that is there."""

from __future__ import annotations

import logging
from contextlib import contextmanager
from importlib.util import find_spec
from typing import TYPE_CHECKING

from ..errors import InputError
from . import worker_preload

if TYPE_CHECKING:
    from collections.abc import Iterator

    from distributed import Client

PATIENCE = 30
"""How long a scheduler may take to answer [s]."""


@contextmanager
def local_client(workers: int | None, cases: int) -> Iterator[Client]:
    """Start worker processes with one thread each, and end them.

    Parameters
    ----------
    workers : int, optional
        How many; without, one for every core that this process may use.
    cases : int
        There are never more workers than cases.

    Yields
    ------
    distributed.Client
        Connected to them.

    Raises
    ------
    InputError
        For less than one worker, or without the library.
    """
    if workers is not None and workers < 1:
        raise InputError(f"--workers is {workers} but must be at least 1")
    _require_library()
    import distributed  # noqa: PLC0415 - an optional library, found just above
    from dask.system import CPU_COUNT  # noqa: PLC0415 - likewise

    cluster = distributed.LocalCluster(
        n_workers=min(workers or CPU_COUNT, cases),
        threads_per_worker=1,
        processes=True,
        preload=worker_preload.__name__,
        dashboard_address="127.0.0.1:0",
        silence_logs=logging.CRITICAL,
    )
    with cluster, distributed.Client(cluster, set_as_default=False) as client:
        yield client


@contextmanager
def remote_client(scheduler: str) -> Iterator[Client]:
    """Connect to a scheduler, and leave its workers alone in the end.

    Parameters
    ----------
    scheduler : str
        Its address, as ``tcp://node:8786``.

    Raises
    ------
    InputError
        For a scheduler that does not answer, or without the library.
    """
    _require_library()
    import distributed  # noqa: PLC0415 - an optional library, found just above

    try:
        client = distributed.Client(scheduler, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError) as error:
        raise InputError(
            f"--scheduler {scheduler} does not answer ({error}): give the address that "
            "dask scheduler prints, as tcp://node:8786"
        ) from error
    with client:
        yield client


def _require_library() -> None:
    """Name what has to be installed where dask.distributed is missing."""
    if find_spec("distributed") is None:
        raise InputError(
            "a sweep needs the library dask.distributed: pip install 'railcosim[sweep]'"
        )
