"""What a study comes to: every case checked, its content key, and what they have in common."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..dataset import count
from ..errors import InputError
from ..keep_section import KEPT
from .identity import Fingerprints, content_key, files_of

if TYPE_CHECKING:
    from collections.abc import Hashable, Iterator

    from numpy.typing import NDArray

    from ..signals import Dimension
    from .case import Case
    from .study import Study


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """The cases of a study, known by their keys; see `make_plan`.

    Attributes
    ----------
    study : Study
        The study.
    keys : tuple of str
        Content keys of the cases, in their order; the same passage has the same key.
    order : tuple of int
        Cases to run, counted from 0: one of every key, those with the same FMUs together.
    fmus, contact : tuple of str
        Builds of the FMUs, and the sides that have the contacts.
    files : tuple of str
        Contents and names of the files that scenarios name, as ``sha256sum`` writes them.
    points : ndarray, shape (n,)
        Distances from the flat's centre that kept histories have in common [m].
    """

    study: Study
    keys: tuple[str, ...]
    order: tuple[int, ...]
    fmus: tuple[str, ...]
    contact: tuple[str, ...]
    files: tuple[str, ...]
    points: NDArray[np.float64]


def make_plan(study: Study) -> Plan:
    """Check every case.

    Raises
    ------
    InputError
        For a case that cannot be run; the message begins with it. Or for histories that cannot
        be put together.
    """
    fingerprints, extent = Fingerprints(), _Extent()
    first: dict[str, int] = {}
    groups: dict[Hashable, list[int]] = {}
    keys, options, files = [], set(), set()
    for index, case in enumerate(study.cases()):
        try:
            case.check_files()
            key = content_key(case, fingerprints)
        except InputError as error:
            raise InputError(f"{case.name}: {error}") from error
        keys.append(key)
        options.add(case.options)
        files |= {(fingerprints.of(path), Path(path).name) for path in files_of(case).values()}
        extent.add(case)
        if first.setdefault(key, index) == index:
            groups.setdefault(case.fmu_group, []).append(index)
    return Plan(
        study=study,
        keys=tuple(keys),
        order=tuple(index for group in groups.values() for index in group),
        fmus=tuple(sorted({option.build for option in options})),
        contact=tuple(sorted({option.contact for option in options})),
        files=tuple(f"{digest}  {name}" for digest, name in sorted(files)),
        points=extent.points(study),
    )


def first_of_each_fmu(plan: Plan) -> Iterator[Case]:
    """Yield one case for each FMU that several processes use."""
    seen = set()
    for index in plan.order:
        case = plan.study.case(index)
        if not case.has_own_fmu and case.fmu_group not in seen:
            seen.add(case.fmu_group)
            yield case


class _Extent:
    """Distances and numbers of wheels, sleepers and gauges of the cases so far."""

    def __init__(self) -> None:
        self._before = self._after = np.inf
        self._numbers: dict[Dimension, set[int]] = {}

    def add(self, case: Case) -> None:
        self._before = min(self._before, case.scenario.run.approach)
        self._after = min(self._after, case.scenario.run.departure)
        for dim, number in count(case.scenario).items():
            self._numbers.setdefault(dim, set()).add(number)

    def points(self, study: Study) -> NDArray[np.float64]:
        """Return the common points of the histories; none where none are kept."""
        keep = study.keep
        if keep.is_all:
            return np.empty(0)
        for name in keep.signals:
            dim = KEPT[name].dim
            if len(self._numbers[dim]) > 1:
                raise InputError(
                    f"keep.signals has {name} but the cases differ in their number of {dim}s: "
                    "leave it out, or sweep them in a study of their own"
                )
        first, after = keep.grid(-self._before, self._after)
        return keep.grid_spacing * np.arange(first, after, dtype=np.float64)
