"""The result of a study: one dataset of all cases, with nothing in it that differs between runs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import xarray as xr

from ..errors import RunError
from ..keep_section import KEPT
from ..run_record import programs
from ..signals import FORWARDS
from .numbers import NUMBERS
from .study import coordinate

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from ..keep_section import Keep
    from .plan import Plan
    from .store import Record, Store
    from .study import Study

Variable: TypeAlias = tuple[tuple[str, ...], "NDArray[Any]", "Mapping[str, str]"]


def assemble_study(plan: Plan, store: Store) -> xr.Dataset:
    """Put the cases of a store together.

    Parameters
    ----------
    plan : Plan
        The cases.
    store : Store
        Where they are.

    Returns
    -------
    xarray.Dataset
        Dimensions `Study.dims`; the numbers of `NUMBERS`, NaN where ``failure`` says why there is
        none; ``warnings``; kept signals with the dimensions ``distance`` and wheel, sleeper or
        gauge too.

    Raises
    ------
    RunError
        For a case that is not in the store, or damaged.
    """
    study, shape = plan.study, plan.study.shape
    records = [_found(store, key) for key in plan.keys]
    variables: dict[str, Variable] = {
        name: (
            study.dims,
            np.array([r.numbers.get(name, np.nan) for r in records]).reshape(shape),
            _attributes(*NUMBERS[name]),
        )
        for name in NUMBERS
    }
    for name, meaning in (
        ("failure", "why the case has no numbers, empty if it has"),
        ("warnings", "what makes the numbers doubtful"),
    ):
        texts = np.array([getattr(record, name) for record in records]).reshape(shape)
        variables[name] = (study.dims, texts, {"long_name": meaning})
    coordinates = _coordinates(study)
    if not study.keep.is_all:
        worked = {n: plan.keys[n] for n, record in enumerate(records) if not record.failure}
        histories, axes = _histories(plan, study.keep, worked, store)
        variables |= histories
        coordinates |= axes
    return xr.Dataset(variables, coords=coordinates, attrs=_provenance(plan, records))


def _found(store: Store, key: str) -> Record:
    record = store.read(key)
    if record is None:
        raise RunError(
            f"the case {key} is not in the store {store.folder}, or damaged: start again, and let "
            "all machines share that folder"
        )
    return record


def _attributes(units: str, long_name: str, sign: str = "none") -> dict[str, str]:
    return {"units": units, "long_name": long_name, "sign": sign}


def _coordinates(study: Study) -> dict[str, Variable]:
    """Label the dimensions by the swept keys."""
    found: dict[str, Variable] = {
        key: ((key,), coordinate(key, values), {"long_name": f"scenario key {key}"})
        for key, values in study.grid.items()
    }
    if study.rows:
        numbers = np.arange(1, len(study.rows) + 1)
        found["case"] = (("case",), numbers, {"long_name": "number of the case"})
    for key in study.row_keys:
        values = coordinate(key, tuple(row[key] for row in study.rows))
        found[key] = (("case",), values, {"long_name": f"scenario key {key}"})
    return found


def _histories(
    plan: Plan, keep: Keep, worked: Mapping[int, str], store: Store
) -> tuple[dict[str, Variable], dict[str, Variable]]:
    """Put histories together over the distances that all cases have in common.

    Parameters
    ----------
    plan, keep
        The cases, and what they keep.
    worked : mapping of int to str
        Content keys by the places of the cases that have histories.
    store : Store
        Where they are.

    Returns
    -------
    tuple of dict
        Variables and coordinates.
    """
    study, points = plan.study, plan.points
    arrays: dict[str, NDArray[np.float64]] = {}
    for place, key in worked.items():
        stored = store.histories(key)
        start = round(points[0] / keep.grid_spacing) - int(stored["first"]) if points.size else 0
        for name in keep.signals:
            part = stored[name][start : start + points.size]
            if name not in arrays:
                arrays[name] = np.full((len(study), *part.shape), np.nan)
            arrays[name][place] = part
    meaning = _attributes("m", "distance of the flat's wheel from the flat's centre", FORWARDS)
    axes: dict[str, Variable] = {"distance": (("distance",), points, meaning)}
    variables: dict[str, Variable] = {}
    for name, values in arrays.items():
        signal = KEPT[name]
        numbers = np.arange(1, values.shape[-1] + 1)
        axes[signal.dim] = (
            (signal.dim,),
            numbers,
            _attributes("1", f"number of the {signal.dim}"),
        )
        variables[name] = (
            (*study.dims, "distance", signal.dim),
            values.reshape(*study.shape, *values.shape[1:]),
            signal.attributes,
        )
    return variables, axes


def _provenance(plan: Plan, records: Sequence[Record]) -> dict[str, str | int]:
    """Say what made the result."""
    return {
        "Conventions": "CF-1.11",
        "title": "Study of passages of wheels over a discretely supported rail",
        "study": plan.study.text,
        "base_scenario": plan.study.base_text,
        "files": "\n".join(plan.files),
        "fmus": ", ".join(plan.fmus),
        "contact": ", ".join(plan.contact),
        **programs(),
        "fmu_guids": "\n".join(sorted({guid for r in records for guid in r.fmu_guids})),
        "cases": len(records),
        "failed_cases": sum(bool(record.failure) for record in records),
    }
