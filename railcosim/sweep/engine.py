"""Cases on their way through the workers: never more than there are threads to run them."""

from __future__ import annotations

from queue import Empty, SimpleQueue
from typing import TYPE_CHECKING, NamedTuple
from uuid import uuid4

from ..errors import InputError, RunError
from .store import Record
from .work import run_case_on_worker

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from distributed import Client, Future

    from .case import Case
    from .store import Store

POLL = 1.0
"""How often new workers are looked for [s]."""

KILLED = (
    "every worker that ran it died: the case may need more memory than a worker has, or its FMU "
    "ends the process"
)


class Job(NamedTuple):
    """A case and its content key."""

    key: str
    case: Case


def run_jobs(
    client: Client, jobs: Iterator[Job], store: Store, settled: Callable[[Job, bool], None]
) -> None:
    """Run cases until there are no more.

    Only as many are submitted as there are threads, so that neither the scheduler nor a worker
    grows with their number, and the death of a worker is blamed on the case that it ran.

    Parameters
    ----------
    client : distributed.Client
        Connected to the workers.
    jobs : iterator of Job
        What to run, made when it is needed.
    store : Store
        Where the workers keep it.
    settled : callable
        Told of every case as it ends, and whether it worked.

    Raises
    ------
    InputError, RunError
        For what stops every case; see `work.run_case`.
    """
    running: dict[str, tuple[Job, Future]] = {}
    ended: SimpleQueue[str] = SimpleQueue()

    def fill() -> None:
        for _ in range(_threads(client) - len(running)):
            job = next(jobs, None)
            if job is None:
                return
            # a name of its own: another client may run the same case into another store
            name = f"case-{uuid4().hex}"
            future = client.submit(
                run_case_on_worker, job.case, job.key, store, key=name, pure=False
            )
            running[name] = (job, future)
            future.add_done_callback(lambda done: ended.put(done.key))

    try:
        fill()
        while running:
            try:
                job, future = running.pop(ended.get(timeout=POLL))
            except Empty:
                fill()
                continue
            worked = _outcome(job, future, store)
            fill()
            settled(job, worked)
    finally:
        client.cancel([future for _, future in running.values()])


def _threads(client: Client) -> int:
    """Return how many cases can run at once; one may wait where no worker has come yet."""
    try:
        threads: dict[str, int] = client.nthreads()
    except OSError as error:
        raise RunError(f"the scheduler is gone ({error}); what has ended is stored") from error
    return max(1, sum(threads.values()))


def _outcome(job: Job, future: Future, store: Store) -> bool:
    """Return whether a case worked."""
    from distributed import KilledWorker  # noqa: PLC0415 - an optional library, in use by now

    if future.status in {"cancelled", "lost"}:
        raise RunError(f"{job.case.name} was cancelled; what has ended is stored")
    error = future.exception()
    if error is None:
        return bool(future.result())
    if isinstance(error, KilledWorker):
        store.write(job.key, Record(swept=job.case.swept, numbers={}, failure=KILLED))
        return False
    if isinstance(error, (InputError, RunError)):
        raise error
    raise RunError(
        f"a worker cannot run {job.case.name} ({type(error).__name__}: {error}): install the same "
        "railcosim there"
    ) from error
