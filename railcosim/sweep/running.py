"""A study from its cases to its result: what is stored stays, the rest is run."""

from __future__ import annotations

from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from ..builds import build_for
from .cluster import check_means, local_client, remote_client
from .engine import Job, run_jobs
from .plan import first_of_each_fmu, make_plan
from .result import assemble_study
from .store import open_store
from .study_file import read_study

if TYPE_CHECKING:
    from collections.abc import Callable, Collection
    from contextlib import AbstractContextManager

    import xarray as xr
    from distributed import Client

    from .plan import Plan
    from .store import Store
    from .study import Study


class SweepProgress(NamedTuple):
    """How far a study is.

    Attributes
    ----------
    total : int
        Cases that differ from each other.
    stored : int
        Those of them that were stored before, failed ones that are not repeated included.
    ended, failed : int
        Those that have been run now, and those of them that failed.
    """

    total: int
    stored: int
    ended: int
    failed: int


def run_study(
    study: Study | Path,
    *,
    store: Path,
    workers: int | None = None,
    scheduler: str | None = None,
    client: Client | None = None,
    retry_failed: bool = False,
    notify: Callable[[str], None] | None = None,
    report: Callable[[SweepProgress], None] | None = None,
) -> xr.Dataset:
    """Run every case of a study that is not stored, and put all together.

    Every case is checked before the first one runs. A case is stored as it ends, so that this can
    be stopped in any way and called again. One that fails is stored with its reason, and the
    others go on. A script that calls this needs ``if __name__ == "__main__":``, since its worker
    processes load it, too.

    Parameters
    ----------
    study : Study or Path
        What to run, from `parse_study`, or the file that `read_study` reads.
    store : Path
        Folder that keeps the cases under hashes of all that they depend on; it is made if it is
        missing, and any number of studies may share it.
    workers : int, optional
        Number of processes on this machine; one for every core without.
    scheduler : str, optional
        Address of a scheduler of dask.distributed, whose workers run the cases instead; they must
        see `store` under the same path.
    client : distributed.Client, optional
        The same as a client that is connected already.
    retry_failed : bool
        Whether cases that have failed before are run again.
    notify : callable, optional
        Told in a few words what is built.
    report : callable, optional
        Told of the progress, at the start and after every case.

    Returns
    -------
    xarray.Dataset
        Dimensions are the keys of the grid, and ``case`` for listed or random cases. Numbers of
        the summary, NaN for failed cases, of which ``failure`` holds the reasons; kept histories
        over ``distance``. Nothing in it depends on when, where or in how many pieces it was made.

    Raises
    ------
    InputError
        For a study, a store, a scheduler or a case that cannot be used.
    RunError
        For what stops every case: FMUs that cannot be built, a store that cannot be written.
    """
    plan = check_study(study, workers=workers)
    cases = open_store(store)
    missing = _missing(plan, cases, retry_failed=retry_failed)
    progress = SweepProgress(len(plan.order), len(plan.order) - len(missing), 0, 0)

    def settled(_: Job, worked: bool) -> None:
        nonlocal progress
        progress = progress._replace(
            ended=progress.ended + 1, failed=progress.failed + (not worked)
        )
        if report is not None:
            report(progress)

    if report is not None:
        report(progress)
    if missing:
        if client is None and scheduler is None:
            for case in first_of_each_fmu(plan):
                build_for(
                    case.scenario, case.options.build, contact=case.options.side, notify=notify
                )
        with _connected(client, scheduler, workers, len(missing)) as connected:
            jobs = (Job(plan.keys[index], plan.study.case(index)) for index in missing)
            run_jobs(connected, jobs, cases, settled)
    return assemble_study(plan, cases)


def check_study(study: Study | Path, *, workers: int | None = None) -> Plan:
    """Check every case, and that there can be workers, before anything is made or run.

    Raises
    ------
    InputError
        For a study or a case that cannot be used, less than one worker, or missing libraries.
    """
    plan = make_plan(read_study(study) if isinstance(study, Path) else study)
    check_means(workers)
    return plan


def _missing(plan: Plan, store: Store, *, retry_failed: bool) -> Collection[int]:
    """Return the cases that have to be run."""
    there = store.keys()  # one look at the folder: what other machines wrote a moment ago is seen

    def is_kept(key: str) -> bool:
        record = store.read(key) if key in there else None
        return record is not None and not (retry_failed and record.failure)

    return [index for index in plan.order if not is_kept(plan.keys[index])]


def _connected(
    client: Client | None, scheduler: str | None, workers: int | None, cases: int
) -> AbstractContextManager[Client]:
    """Return the client to use; the given one is left open."""
    if client is not None:
        return nullcontext(client)
    return remote_client(scheduler) if scheduler else local_client(workers, cases)
