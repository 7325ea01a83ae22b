"""What a worker does: run one case and keep what is left of it."""

from __future__ import annotations

import time
import traceback
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..errors import BuildError, InputError, RunError
from ..passage import run_passage
from ..result_check import check_result
from .identity import Fingerprints, content_key
from .numbers import numbers_of
from .store import Record

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

    from ..scenario import Scenario
    from .case import Case
    from .store import Store

OWN_FMUS = "railcosim-fmus"
"""Folder of a worker for FMUs of one track only."""


def run_case(case: Case, key: str, store: Store, scratch: Path) -> bool:
    """Run a case and keep its numbers, or the reason why it failed.

    Parameters
    ----------
    case : Case
        What to run.
    key : str
        Its content key.
    store : Store
        Where it is kept.
    scratch : Path
        Folder of this process alone: of FMUs that serve one track only the last few are kept,
        which other processes must not depend on.

    Returns
    -------
    bool
        Whether the case has not failed.

    Raises
    ------
    RunError
        Where that does not lie with the case: FMUs that cannot be built, a store that cannot be
        written, other programs or files than where the study was started.
    """
    if not store.is_there():
        raise RunError(
            f"a worker does not see the store {store.folder}: put it into a folder that all "
            "machines share"
        )
    if content_key(case, Fingerprints()) != key:
        raise RunError(
            f"a worker has another railcosim, other libraries or other files than {case.name} was "
            "checked with: install the same versions, share the files and start again"
        )
    start = time.perf_counter()
    histories = None
    try:
        record, histories = _run(case, scratch)
    except BuildError:
        raise
    except (InputError, RunError) as error:
        record = Record(swept=case.swept, numbers={}, failure=str(error))
    except Exception as error:  # noqa: BLE001 - one case must not end the others; kept with all it says
        record = Record(
            swept=case.swept,
            numbers={},
            failure=f"{type(error).__name__}: {error}",
            traceback=traceback.format_exc(),
        )
    store.write(key, record.timed(time.perf_counter() - start), histories)
    return not record.failure


def run_case_on_worker(case: Case, key: str, store: Store) -> bool:
    """Do the same in a worker of dask, which must run one case at a time.

    Raises
    ------
    RunError
        As `run_case`, and on a worker with several threads.
    """
    from distributed import get_worker  # noqa: PLC0415 - an optional library, there on a worker

    worker = get_worker()
    if worker.state.nthreads != 1:
        raise RunError(
            f"a worker has {worker.state.nthreads} threads but must have one: start it with "
            "--nthreads 1"
        )
    return run_case(case, key, store, Path(worker.local_directory) / OWN_FMUS)


def _run(case: Case, scratch: Path) -> tuple[Record, dict[str, NDArray[np.float64]] | None]:
    """Run a case that can be expected to work."""
    passage = run_passage(
        case.scenario,
        fmus=case.options.build,
        contact=case.options.side,
        directory=scratch if case.has_own_fmu else None,
    )
    check_result(passage)
    record = Record(
        swept=case.swept,
        numbers=numbers_of(passage),
        warnings=passage.attrs["warnings"],
        fmu_guids=(passage.attrs["track_fmu_guid"], passage.attrs["vehicle_fmu_guid"]),
    )
    keeps = not case.scenario.keep.is_all
    return record, _histories(passage, case.scenario) if keeps else None


def _histories(passage: xr.Dataset, scenario: Scenario) -> dict[str, NDArray[np.float64]]:
    """Return the kept signals by name; ``first`` is the multiple of the spacing of the first."""
    keep, run = scenario.keep, scenario.run
    first, _ = keep.grid(-run.approach, run.departure)
    return {"first": np.array(first)} | {name: passage[name].to_numpy() for name in keep.signals}
