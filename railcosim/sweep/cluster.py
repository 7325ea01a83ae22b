"""The workers of a sweep: processes on this machine, or those of a scheduler that is there."""

from __future__ import annotations

import logging
from contextlib import contextmanager
from importlib.util import find_spec
from typing import TYPE_CHECKING

from orchestrator.interrupt import deferred_interrupt

from ..errors import InputError, RunError
from . import worker_preload

if TYPE_CHECKING:
    from collections.abc import Iterator

    from distributed import Client, LocalCluster

PATIENCE = 30
"""How long a scheduler may take to answer [s]."""

LIBRARIES = ("dask", "distributed")
"""What the workers are made with."""


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
    RunError
        For processes that cannot be started.
    """
    import distributed  # noqa: PLC0415 - an optional library; see `check_means`
    from dask.config import set as configured  # noqa: PLC0415 - likewise
    from dask.system import CPU_COUNT  # noqa: PLC0415 - likewise

    # the profile that a worker keeps of an hour takes a hundred kilobytes a second
    without_profile = configured({"distributed.worker.profile.enabled": False})
    with (
        without_profile,
        _local_cluster(min(workers or CPU_COUNT, cases)) as cluster,
        distributed.Client(cluster, set_as_default=False) as client,
    ):
        yield client


def _local_cluster(workers: int) -> LocalCluster:
    """Start so many workers, whole: a cluster that is interrupted halfway prints tracebacks.

    Raises
    ------
    RunError
        For processes that cannot be started.
    """
    import distributed  # noqa: PLC0415 - an optional library; see `check_means`

    with deferred_interrupt() as interrupt:
        try:
            cluster = distributed.LocalCluster(
                n_workers=workers,
                threads_per_worker=1,
                processes=True,
                preload=worker_preload.__name__,
                dashboard_address="127.0.0.1:0",
                silence_logs=logging.CRITICAL,
            )
        except (RuntimeError, OSError) as error:
            if interrupt.requested:  # the workers got the same signal
                raise KeyboardInterrupt from error
            raise RunError(
                f"the worker processes cannot be started ({error}): ask for fewer --workers; a "
                'script needs if __name__ == "__main__": around run_study'
            ) from error
    if interrupt.requested:
        cluster.close()
        raise KeyboardInterrupt
    return cluster


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
        For a scheduler that does not answer.
    """
    import distributed  # noqa: PLC0415 - an optional library; see `check_means`

    try:
        client = distributed.Client(scheduler, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError) as error:
        raise InputError(
            f"--scheduler {scheduler} does not answer ({error}): give the address that "
            "dask scheduler prints, as tcp://node:8786"
        ) from error
    with client:
        yield client


def check_means(workers: int | None) -> None:
    """Find out, before anything is made, whether there can be workers.

    Raises
    ------
    InputError
        For less than one worker, or without the libraries.
    """
    if workers is not None and workers < 1:
        raise InputError(f"--workers is {workers} but must be at least 1")
    if any(find_spec(name) is None for name in LIBRARIES):
        raise InputError(
            "a sweep needs the library dask.distributed: pip install 'railcosim[sweep]'"
        )
