"""Results as MATLAB files."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from .errors import RunError

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    import xarray as xr

LONGEST_NAME = 63
"""Characters of a name that MATLAB tells apart."""

LARGEST = 2**31 - 1
"""Bytes of an array that a MAT file of version 5 holds."""

ABOUT = "about"
"""Variable that says what the others are."""


def write_mat(result: xr.Dataset, path: Path) -> None:
    """Write every variable as an array, and the structure ``about`` with what they mean.

    ``about.attributes`` are those of the result; ``about.variables.NAME`` has the attributes of a
    variable, its dimensions and, where MATLAB does not take the name, its ``original_name``.
    Series become columns, truths logical arrays, texts cell arrays.

    Parameters
    ----------
    result : xarray.Dataset
        What to write.
    path : Path
        File to write.

    Raises
    ------
    RunError
        For an array that is too large for this kind of file.
    """
    from scipy.io import savemat  # noqa: PLC0415 - only this kind of file needs it

    names = dict(zip(result.variables, _names(map(str, result.variables)), strict=True))
    arrays, meanings = {}, {}
    for original, name in names.items():
        variable = result[original]
        if variable.nbytes > LARGEST:
            raise RunError(
                f"{original} has {variable.nbytes / 1e9:.1f} GB but an array in a MAT file at most "
                f"{LARGEST / 1e9:.1f} GB: write a .nc file, which MATLAB reads too"
            )
        values = variable.to_numpy()
        arrays[name] = values.astype(object) if values.dtype.kind in "US" else values
        meanings[name] = _attributes(variable.attrs) | {
            "dimensions": ", ".join(str(names.get(dim, dim)) for dim in variable.dims),
            **({} if name == original else {"original_name": str(original)}),
        }
    about = {"attributes": _attributes(result.attrs), "variables": meanings}
    savemat(path, arrays | {ABOUT: about}, long_field_names=True, oned_as="column")


def _names(originals: Iterable[str]) -> list[str]:
    """Make names that MATLAB takes, each once: ``track.wheel[1].x`` becomes ``track_wheel_1_x``."""
    taken, names = {ABOUT}, []
    for original in originals:
        name = re.sub(r"\W+", "_", original, flags=re.ASCII).strip("_")
        whole = name = (name if name[:1].isalpha() else f"v_{name}")[:LONGEST_NAME]
        number = 1
        while name in taken:
            number += 1
            ending = f"_{number}"
            name = whole[: LONGEST_NAME - len(ending)] + ending
        taken.add(name)
        names.append(name)
    return names


def _attributes(attributes: dict[Any, Any]) -> dict[str, Any]:
    """Return attributes under names that MATLAB takes."""
    return dict(zip(_names(map(str, attributes)), attributes.values(), strict=True))
