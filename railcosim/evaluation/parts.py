"""The parts of an evaluation, one by one and together."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import xarray as xr

from ..passage_check import check_passage
from ..run_record import programs
from .gauges import gauge_histories
from .settings import Evaluation, PartName
from .spectrum import contact_force_spectrum
from .supports import support_loads
from .third_octaves import third_octaves, wavelength_bands
from .wheel_load_detector import wheel_load_record
from .wheels import wheel_loads

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping


@dataclass(frozen=True, slots=True, kw_only=True)
class Part:
    """A part of an evaluation.

    Attributes
    ----------
    make : callable
        From the result of a passage and the user's choices.
    along : str
        Dimension of its rows as a table.
    """

    make: Callable[[xr.Dataset, Evaluation], xr.Dataset]
    along: str


PARTS: Mapping[PartName, Part] = {
    PartName.WHEELS: Part(make=lambda passage, _: wheel_loads(passage), along="wheel"),
    PartName.SPECTRUM: Part(make=contact_force_spectrum, along="frequency"),
    PartName.THIRD_OCTAVES: Part(make=third_octaves, along="band_frequency"),
    PartName.WAVELENGTHS: Part(make=wavelength_bands, along="band_wavelength"),
    PartName.DETECTOR: Part(make=wheel_load_record, along="record_time"),
    PartName.BAYS: Part(make=wheel_load_record, along="bay"),
    PartName.GAUGES: Part(make=gauge_histories, along="time"),
    PartName.SUPPORTS: Part(make=lambda passage, _: support_loads(passage), along="sleeper"),
}
"""How every part is made."""


def evaluate(
    passage: xr.Dataset, settings: Evaluation | None = None, *, part: PartName | None = None
) -> xr.Dataset:
    """Evaluate the result of a passage.

    Parameters
    ----------
    passage : xarray.Dataset
        The result, also read back from a file.
    settings : Evaluation, optional
        What the user chose.
    part : PartName, optional
        Which part; all of them without.

    Returns
    -------
    xarray.Dataset
        The part, or everything together; with the scenario it belongs to and whether its run was
        ``complete`` and what makes it ``unreliable``.

    Raises
    ------
    InputError
        For the result of something else or a run too short.
    """
    check_passage(passage, "this dataset")
    settings = settings or Evaluation()
    chosen = PARTS.values() if part is None else [PARTS[part]]
    made = {item.make: None for item in chosen}  # two parts are tables of the same record
    found = xr.merge(
        [make(passage, settings) for make in made],
        join="exact",
        compat="identical",
        combine_attrs="no_conflicts",
    )
    return found.assign_attrs(
        {
            "Conventions": "CF-1.11",
            "title": "Evaluation of a passage of wheels over a discretely supported rail",
            "scenario": passage.attrs["scenario"],
            "complete": passage.attrs["complete"],
            "unreliable": passage.attrs["unreliable"],
            **programs(),
        }
    )
